# Print an optspec for argparse to handle cmd's options that are independent of any subcommand.
function __fish_regatta_global_optspecs
    string join \n scene= k= c= frequency= damping-ratio= mass= method= tick-hz= race loop= seconds= record= force theme= rewind-mb= reduced-motion h/help V/version
end

function __fish_regatta_needs_command
    # Figure out if the current invocation already has a command.
    set -l cmd (commandline -opc)
    set -e cmd[1]
    argparse -s (__fish_regatta_global_optspecs) -- $cmd 2>/dev/null
    or return
    if set -q argv[1]
        # Also print the command, so this can be used to figure out what it is.
        echo $argv[1]
        return 1
    end
    return 0
end

function __fish_regatta_using_subcommand
    set -l cmd (__fish_regatta_needs_command)
    test -z "$cmd"
    and return 1
    contains -- $cmd[1] $argv
end

complete -c regatta -n "__fish_regatta_needs_command" -l scene -d 'A scene or the file of one [default: harbour]' -r -f -a "harbour\t''
ship\t''
spring\t''
stiff\t''
surge\t''
chain\t''
pendulum\t''
liouville\t''
kicked-rotor\t''
orbit\t''
helm\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
rope\t''
cloth\t''
bridge\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''"
complete -c regatta -n "__fish_regatta_needs_command" -l k -d 'A spring of this stiffness in place of a scene' -r
complete -c regatta -n "__fish_regatta_needs_command" -l c -d 'The damping of the spring of --k [default: 0]' -r
complete -c regatta -n "__fish_regatta_needs_command" -l frequency -d 'A spring of this frequency in place of a scene' -r
complete -c regatta -n "__fish_regatta_needs_command" -l damping-ratio -d 'The damping of that spring [default: 0]' -r
complete -c regatta -n "__fish_regatta_needs_command" -l mass -d 'The mass on the spring [default: 1]' -r
complete -c regatta -n "__fish_regatta_needs_command" -l method -d 'A method (`regatta list methods`), or several' -r -f -a "explicit-euler\t''
midpoint\t''
improved-euler\t''
ssp-rk3\t''
rk4\t''
adams-bashforth-2\t''
semi-implicit-euler\t''
velocity-verlet\t''
position-verlet\t''
stormer-verlet\t''
yoshida4\t''
pefrl\t''
adaptive-euler\t''
bogacki-shampine-32\t''
dormand-prince-54\t''
implicit-euler\t''
implicit-midpoint\t''
newmark\t''
bdf2\t''
gauss-legendre-4\t''
tr-bdf2\t''
linearly-implicit-euler\t''
semi-implicit-euler-implicit-drag\t''
verlet-exact-drag\t''
exponential-rosenbrock-euler\t''
improved-euler-as-printed\t''
rk4-as-printed\t''
adaptive-euler-as-printed\t''
jakobsen-verlet\t''
lerp-per-frame\t''
lerp-dt\t''
exponential-decay\t''
smooth-damp\t''
critically-damped-spring\t''
implicit-spring\t''
engine-box2d\t''
engine-rapier\t''
engine-avian\t''
engine-avian-motor\t''
engine-jolt\t''
engine-physx\t''
engine-physx-tgs\t''
engine-physx-tgs-56\t''
engine-bullet\t''
engine-pybullet\t''
engine-chipmunk\t''
engine-mujoco\t''
engine-mujoco-rk4\t''
engine-godot\t''
engine-box3d\t''
held-force\t''"
complete -c regatta -n "__fish_regatta_needs_command" -l tick-hz -d 'Ticks per second [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_needs_command" -l loop -d 'Open the loop lab on a trace [default: edge]' -r
complete -c regatta -n "__fish_regatta_needs_command" -l seconds -d 'Close after these simulated seconds' -r
complete -c regatta -n "__fish_regatta_needs_command" -l record -d 'Write the run to FILE as a scene' -r -F
complete -c regatta -n "__fish_regatta_needs_command" -l theme -d 'The theme: dark or light' -r -f -a "dark\t''
light\t''"
complete -c regatta -n "__fish_regatta_needs_command" -l rewind-mb -d 'Memory for rewinding a run [default: 64]' -r
complete -c regatta -n "__fish_regatta_needs_command" -l race -d 'Race all methods of the scene at once'
complete -c regatta -n "__fish_regatta_needs_command" -l force -d 'Replace the --record FILE if it exists'
complete -c regatta -n "__fish_regatta_needs_command" -l reduced-motion -d 'Trails do not fade, and the camera zooms out in steps'
complete -c regatta -n "__fish_regatta_needs_command" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_needs_command" -s V -l version -d 'Print version'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "play" -d 'Open the window (also without `play`)'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "capture" -d 'Draw a run into numbered pictures, without a window'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "verify" -d 'Run a capture or a recording again and say what has changed'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "trace" -d 'Write the truth and every lane\'s numbers, tick by tick'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "advise" -d 'Recommend a method and its substeps for a scene at its tick rate'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "sweep" -d 'Run every method at every tick rate on every scene, a row each'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "cloud" -d 'Step a shape of many starts and show what becomes of its area'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "loop" -d 'Measure what game loops do to motion on a display'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "identify" -d 'Say which engine or method made a log of a motion'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "port" -d 'Say with what settings a spring moves alike in all engines'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "show" -d 'Print a method as a function in Rust, C, C# or GDScript'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "chapter" -d 'Print the chapter\'s tables, and draw its Figures 7-2 to 7-8'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "list" -d 'List scenes, methods, bodies, metrics, policies, traces or keys'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "completions" -d 'Print a completion script for a shell'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "help" -d 'Print this help, that of a command, or a chapter of the manual'
complete -c regatta -n "__fish_regatta_using_subcommand play" -l scene -d 'A scene or the file of one [default: harbour]' -r -f -a "harbour\t''
ship\t''
spring\t''
stiff\t''
surge\t''
chain\t''
pendulum\t''
liouville\t''
kicked-rotor\t''
orbit\t''
helm\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
rope\t''
cloth\t''
bridge\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''"
complete -c regatta -n "__fish_regatta_using_subcommand play" -l k -d 'A spring of this stiffness in place of a scene' -r
complete -c regatta -n "__fish_regatta_using_subcommand play" -l c -d 'The damping of the spring of --k [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand play" -l frequency -d 'A spring of this frequency in place of a scene' -r
complete -c regatta -n "__fish_regatta_using_subcommand play" -l damping-ratio -d 'The damping of that spring [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand play" -l mass -d 'The mass on the spring [default: 1]' -r
complete -c regatta -n "__fish_regatta_using_subcommand play" -l method -d 'A method (`regatta list methods`), or several' -r -f -a "explicit-euler\t''
midpoint\t''
improved-euler\t''
ssp-rk3\t''
rk4\t''
adams-bashforth-2\t''
semi-implicit-euler\t''
velocity-verlet\t''
position-verlet\t''
stormer-verlet\t''
yoshida4\t''
pefrl\t''
adaptive-euler\t''
bogacki-shampine-32\t''
dormand-prince-54\t''
implicit-euler\t''
implicit-midpoint\t''
newmark\t''
bdf2\t''
gauss-legendre-4\t''
tr-bdf2\t''
linearly-implicit-euler\t''
semi-implicit-euler-implicit-drag\t''
verlet-exact-drag\t''
exponential-rosenbrock-euler\t''
improved-euler-as-printed\t''
rk4-as-printed\t''
adaptive-euler-as-printed\t''
jakobsen-verlet\t''
lerp-per-frame\t''
lerp-dt\t''
exponential-decay\t''
smooth-damp\t''
critically-damped-spring\t''
implicit-spring\t''
engine-box2d\t''
engine-rapier\t''
engine-avian\t''
engine-avian-motor\t''
engine-jolt\t''
engine-physx\t''
engine-physx-tgs\t''
engine-physx-tgs-56\t''
engine-bullet\t''
engine-pybullet\t''
engine-chipmunk\t''
engine-mujoco\t''
engine-mujoco-rk4\t''
engine-godot\t''
engine-box3d\t''
held-force\t''"
complete -c regatta -n "__fish_regatta_using_subcommand play" -l tick-hz -d 'Ticks per second [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand play" -l loop -d 'Open the loop lab on a trace [default: edge]' -r
complete -c regatta -n "__fish_regatta_using_subcommand play" -l seconds -d 'Close after these simulated seconds' -r
complete -c regatta -n "__fish_regatta_using_subcommand play" -l record -d 'Write the run to FILE as a scene' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand play" -l theme -d 'The theme: dark or light' -r -f -a "dark\t''
light\t''"
complete -c regatta -n "__fish_regatta_using_subcommand play" -l rewind-mb -d 'Memory for rewinding a run [default: 64]' -r
complete -c regatta -n "__fish_regatta_using_subcommand play" -l race -d 'Race all methods of the scene at once'
complete -c regatta -n "__fish_regatta_using_subcommand play" -l force -d 'Replace the --record FILE if it exists'
complete -c regatta -n "__fish_regatta_using_subcommand play" -l reduced-motion -d 'Trails do not fade, and the camera zooms out in steps'
complete -c regatta -n "__fish_regatta_using_subcommand play" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l scene -d 'A scene or the file of one [default: harbour]' -r -f -a "harbour\t''
ship\t''
spring\t''
stiff\t''
surge\t''
chain\t''
pendulum\t''
liouville\t''
kicked-rotor\t''
orbit\t''
helm\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
rope\t''
cloth\t''
bridge\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''"
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l k -d 'A spring of this stiffness in place of a scene' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l c -d 'The damping of the spring of --k [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l frequency -d 'A spring of this frequency in place of a scene' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l damping-ratio -d 'The damping of that spring [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l mass -d 'The mass on the spring [default: 1]' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l method -d 'A method (`regatta list methods`), or several' -r -f -a "explicit-euler\t''
midpoint\t''
improved-euler\t''
ssp-rk3\t''
rk4\t''
adams-bashforth-2\t''
semi-implicit-euler\t''
velocity-verlet\t''
position-verlet\t''
stormer-verlet\t''
yoshida4\t''
pefrl\t''
adaptive-euler\t''
bogacki-shampine-32\t''
dormand-prince-54\t''
implicit-euler\t''
implicit-midpoint\t''
newmark\t''
bdf2\t''
gauss-legendre-4\t''
tr-bdf2\t''
linearly-implicit-euler\t''
semi-implicit-euler-implicit-drag\t''
verlet-exact-drag\t''
exponential-rosenbrock-euler\t''
improved-euler-as-printed\t''
rk4-as-printed\t''
adaptive-euler-as-printed\t''
jakobsen-verlet\t''
lerp-per-frame\t''
lerp-dt\t''
exponential-decay\t''
smooth-damp\t''
critically-damped-spring\t''
implicit-spring\t''
engine-box2d\t''
engine-rapier\t''
engine-avian\t''
engine-avian-motor\t''
engine-jolt\t''
engine-physx\t''
engine-physx-tgs\t''
engine-physx-tgs-56\t''
engine-bullet\t''
engine-pybullet\t''
engine-chipmunk\t''
engine-mujoco\t''
engine-mujoco-rk4\t''
engine-godot\t''
engine-box3d\t''
held-force\t''"
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l tick-hz -d 'Ticks per second [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l loop -d 'Show the loop lab over a trace [default: edge]' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l out -d 'The directory of the frames, or the file' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l frames -d 'How many frames to draw' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l seconds -d 'Simulated seconds to draw [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l fps -d 'Frames per simulated second [default: 30]' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l size -d 'Width and height in pixels [default: 1280x720]' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l scale -d 'The size of text and lines' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l theme -d 'The theme: dark or light [default: dark]' -r -f -a "dark\t''
light\t''"
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l panels -d 'Panels around the stage: on or off' -r -f -a "on\t''
off\t''"
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l instrument -d 'The instrument [default: motion]' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l shape -d 'What the instrument cloud shows [default: cat]' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l mark-every -d 'Ticks between two states in the manifest' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l format -d 'The format: png, apng, gif, y4m, rgba or sheet' -r -f -a "png\t'Numbered pictures and a manifest in a directory'
apng\t'One animated PNG'
gif\t'One GIF, each frame with a palette of its own'
y4m\t'YUV4MPEG2, for a video encoder'
rgba\t'Raw RGBA bytes, for a video encoder'
sheet\t'One picture, time across, lanes down'"
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l race -d 'Race all methods of the scene at once'
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l force -d 'Replace the frames in DIR, or FILE'
complete -c regatta -n "__fish_regatta_using_subcommand capture" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand verify" -l report -d 'Also write the result to FILE, as junit or json' -r
complete -c regatta -n "__fish_regatta_using_subcommand verify" -l diff -d 'Draw the difference of each such frame into DIR' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand verify" -l max-channel -d 'The largest allowed difference of a channel, 0 to 255' -r
complete -c regatta -n "__fish_regatta_using_subcommand verify" -l max-pixels -d 'The largest allowed percentage of pixels off by more than 1' -r
complete -c regatta -n "__fish_regatta_using_subcommand verify" -l physics-only -d 'Judge only the physics; needs no graphics'
complete -c regatta -n "__fish_regatta_using_subcommand verify" -l bless -d 'Accept the present results'
complete -c regatta -n "__fish_regatta_using_subcommand verify" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l scene -d 'A scene or the file of one [default: harbour]' -r -f -a "harbour\t''
ship\t''
spring\t''
stiff\t''
surge\t''
chain\t''
pendulum\t''
liouville\t''
kicked-rotor\t''
orbit\t''
helm\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
rope\t''
cloth\t''
bridge\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''"
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l k -d 'A spring of this stiffness in place of a scene' -r
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l c -d 'The damping of the spring of --k [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l frequency -d 'A spring of this frequency in place of a scene' -r
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l damping-ratio -d 'The damping of that spring [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l mass -d 'The mass on the spring [default: 1]' -r
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l method -d 'A method (`regatta list methods`), or several' -r -f -a "explicit-euler\t''
midpoint\t''
improved-euler\t''
ssp-rk3\t''
rk4\t''
adams-bashforth-2\t''
semi-implicit-euler\t''
velocity-verlet\t''
position-verlet\t''
stormer-verlet\t''
yoshida4\t''
pefrl\t''
adaptive-euler\t''
bogacki-shampine-32\t''
dormand-prince-54\t''
implicit-euler\t''
implicit-midpoint\t''
newmark\t''
bdf2\t''
gauss-legendre-4\t''
tr-bdf2\t''
linearly-implicit-euler\t''
semi-implicit-euler-implicit-drag\t''
verlet-exact-drag\t''
exponential-rosenbrock-euler\t''
improved-euler-as-printed\t''
rk4-as-printed\t''
adaptive-euler-as-printed\t''
jakobsen-verlet\t''
lerp-per-frame\t''
lerp-dt\t''
exponential-decay\t''
smooth-damp\t''
critically-damped-spring\t''
implicit-spring\t''
engine-box2d\t''
engine-rapier\t''
engine-avian\t''
engine-avian-motor\t''
engine-jolt\t''
engine-physx\t''
engine-physx-tgs\t''
engine-physx-tgs-56\t''
engine-bullet\t''
engine-pybullet\t''
engine-chipmunk\t''
engine-mujoco\t''
engine-mujoco-rk4\t''
engine-godot\t''
engine-box3d\t''
held-force\t''"
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l tick-hz -d 'Ticks per second [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l seconds -d 'Simulated seconds [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l every -d 'Write only the ticks that are multiples of N' -r
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l format -d 'How to write it: csv or json' -r -f -a "csv\t'Comma-separated values under a header'
json\t'An array of objects with the same names'"
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l metrics -d 'Write each metric too (`regatta list metrics`)'
complete -c regatta -n "__fish_regatta_using_subcommand trace" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l scene -d 'A scene or the file of one [default: harbour]' -r -f -a "harbour\t''
ship\t''
spring\t''
stiff\t''
surge\t''
chain\t''
pendulum\t''
liouville\t''
kicked-rotor\t''
orbit\t''
helm\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
rope\t''
cloth\t''
bridge\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''"
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l k -d 'A spring of this stiffness in place of a scene' -r
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l c -d 'The damping of the spring of --k [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l frequency -d 'A spring of this frequency in place of a scene' -r
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l damping-ratio -d 'The damping of that spring [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l mass -d 'The mass on the spring [default: 1]' -r
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l method -d 'A method (`regatta list methods`), or several' -r -f -a "explicit-euler\t''
midpoint\t''
improved-euler\t''
ssp-rk3\t''
rk4\t''
adams-bashforth-2\t''
semi-implicit-euler\t''
velocity-verlet\t''
position-verlet\t''
stormer-verlet\t''
yoshida4\t''
pefrl\t''
adaptive-euler\t''
bogacki-shampine-32\t''
dormand-prince-54\t''
implicit-euler\t''
implicit-midpoint\t''
newmark\t''
bdf2\t''
gauss-legendre-4\t''
tr-bdf2\t''
linearly-implicit-euler\t''
semi-implicit-euler-implicit-drag\t''
verlet-exact-drag\t''
exponential-rosenbrock-euler\t''
improved-euler-as-printed\t''
rk4-as-printed\t''
adaptive-euler-as-printed\t''
jakobsen-verlet\t''
lerp-per-frame\t''
lerp-dt\t''
exponential-decay\t''
smooth-damp\t''
critically-damped-spring\t''
implicit-spring\t''
engine-box2d\t''
engine-rapier\t''
engine-avian\t''
engine-avian-motor\t''
engine-jolt\t''
engine-physx\t''
engine-physx-tgs\t''
engine-physx-tgs-56\t''
engine-bullet\t''
engine-pybullet\t''
engine-chipmunk\t''
engine-mujoco\t''
engine-mujoco-rk4\t''
engine-godot\t''
engine-box3d\t''
held-force\t''"
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l tick-hz -d 'Ticks per second [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l family -d 'Judge the methods of this family' -r
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l as -d 'Print the recommended method as code too' -r -f -a "rust\t''
c\t''
csharp\t''
gdscript\t''"
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l format -d 'The format: text or json' -r -f -a "text\t'Aligned columns, for people'
json\t'An array of objects, for programs'"
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l rates -d 'Also search the slowest tick rates'
complete -c regatta -n "__fish_regatta_using_subcommand advise" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l scene -d 'A scene, or several [default: all built-in ones]' -r -f -a "harbour\t''
ship\t''
spring\t''
stiff\t''
surge\t''
chain\t''
pendulum\t''
liouville\t''
kicked-rotor\t''
orbit\t''
helm\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
rope\t''
cloth\t''
bridge\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''"
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l k -d 'A spring of this stiffness in place of a scene' -r
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l c -d 'The damping of the spring of --k [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l frequency -d 'A spring of this frequency in place of a scene' -r
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l damping-ratio -d 'The damping of that spring [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l mass -d 'The mass on the spring [default: 1]' -r
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l method -d 'A method, or several [default: all]' -r -f -a "explicit-euler\t''
midpoint\t''
improved-euler\t''
ssp-rk3\t''
rk4\t''
adams-bashforth-2\t''
semi-implicit-euler\t''
velocity-verlet\t''
position-verlet\t''
stormer-verlet\t''
yoshida4\t''
pefrl\t''
adaptive-euler\t''
bogacki-shampine-32\t''
dormand-prince-54\t''
implicit-euler\t''
implicit-midpoint\t''
newmark\t''
bdf2\t''
gauss-legendre-4\t''
tr-bdf2\t''
linearly-implicit-euler\t''
semi-implicit-euler-implicit-drag\t''
verlet-exact-drag\t''
exponential-rosenbrock-euler\t''
improved-euler-as-printed\t''
rk4-as-printed\t''
adaptive-euler-as-printed\t''
jakobsen-verlet\t''
lerp-per-frame\t''
lerp-dt\t''
exponential-decay\t''
smooth-damp\t''
critically-damped-spring\t''
implicit-spring\t''
engine-box2d\t''
engine-rapier\t''
engine-avian\t''
engine-avian-motor\t''
engine-jolt\t''
engine-physx\t''
engine-physx-tgs\t''
engine-physx-tgs-56\t''
engine-bullet\t''
engine-pybullet\t''
engine-chipmunk\t''
engine-mujoco\t''
engine-mujoco-rk4\t''
engine-godot\t''
engine-box3d\t''
held-force\t''"
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l tick-hz -d 'Tick rates in Hz, separated by commas' -r
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l vary -d 'Values of a parameter: a row for each' -r
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l seconds -d 'Simulated seconds of each run' -r
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l format -d 'How to write it: csv or json' -r -f -a "csv\t'Comma-separated values under a header'
json\t'An array of objects with the same names'"
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l threads -d 'Threads, 1 to 256 [default: one for each core]' -r
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l out -d 'The file of the rows, or - for standard output' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l plot -d 'Draw work-precision diagrams as PNG into FILE' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l force -d 'Replace the files that are there'
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l scene -d 'A scene or the file of one [default: harbour]' -r -f -a "harbour\t''
ship\t''
spring\t''
stiff\t''
surge\t''
chain\t''
pendulum\t''
liouville\t''
kicked-rotor\t''
orbit\t''
helm\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
rope\t''
cloth\t''
bridge\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''"
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l k -d 'A spring of this stiffness in place of a scene' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l c -d 'The damping of the spring of --k [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l frequency -d 'A spring of this frequency in place of a scene' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l damping-ratio -d 'The damping of that spring [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l mass -d 'The mass on the spring [default: 1]' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l method -d 'A method (`regatta list methods`), or several' -r -f -a "explicit-euler\t''
midpoint\t''
improved-euler\t''
ssp-rk3\t''
rk4\t''
adams-bashforth-2\t''
semi-implicit-euler\t''
velocity-verlet\t''
position-verlet\t''
stormer-verlet\t''
yoshida4\t''
pefrl\t''
adaptive-euler\t''
bogacki-shampine-32\t''
dormand-prince-54\t''
implicit-euler\t''
implicit-midpoint\t''
newmark\t''
bdf2\t''
gauss-legendre-4\t''
tr-bdf2\t''
linearly-implicit-euler\t''
semi-implicit-euler-implicit-drag\t''
verlet-exact-drag\t''
exponential-rosenbrock-euler\t''
improved-euler-as-printed\t''
rk4-as-printed\t''
adaptive-euler-as-printed\t''
jakobsen-verlet\t''
lerp-per-frame\t''
lerp-dt\t''
exponential-decay\t''
smooth-damp\t''
critically-damped-spring\t''
implicit-spring\t''
engine-box2d\t''
engine-rapier\t''
engine-avian\t''
engine-avian-motor\t''
engine-jolt\t''
engine-physx\t''
engine-physx-tgs\t''
engine-physx-tgs-56\t''
engine-bullet\t''
engine-pybullet\t''
engine-chipmunk\t''
engine-mujoco\t''
engine-mujoco-rk4\t''
engine-godot\t''
engine-box3d\t''
held-force\t''"
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l tick-hz -d 'Ticks per second [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l points -d 'Starts, 1 to 1000000000' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l shape -d 'The shape of the starts: cat, disc or ring' -r -f -a "cat\t''
disc\t''
ring\t''"
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l size -d 'The reach of the shape' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l seconds -d 'Simulated seconds of the run' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l section -d 'Draw the points at this frequency only' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l threads -d 'Threads, 1 to 256 [default: one for each core]' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l out -d 'FILE.png, FILE.gif, FILE.csv, or - for the rows' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l force -d 'Replace the file if it is there'
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l policy -d 'A policy, or several [default: all]' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l trace -d 'A trace, or several [default: all built-in ones]' -r -f -a "steady-60\t''
steady-59.94\t''
steady-75\t''
steady-120\t''
steady-144\t''
steady-240\t''
edge\t''
missed-vsync\t''
heartbeat\t''
hitch-100ms\t''
alt-tab-5s\t''
spiral\t''
jitter\t''"
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l tick-hz -d 'Ticks per second [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l display-hz -d 'The refresh rate [default: the trace\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l scene -d 'A scene or the file of one' -r -f -a "harbour\t''
ship\t''
spring\t''
stiff\t''
surge\t''
chain\t''
pendulum\t''
liouville\t''
kicked-rotor\t''
orbit\t''
helm\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
rope\t''
cloth\t''
bridge\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''"
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l method -d 'The method of the bodies' -r -f -a "explicit-euler\t''
midpoint\t''
improved-euler\t''
ssp-rk3\t''
rk4\t''
adams-bashforth-2\t''
semi-implicit-euler\t''
velocity-verlet\t''
position-verlet\t''
stormer-verlet\t''
yoshida4\t''
pefrl\t''
adaptive-euler\t''
bogacki-shampine-32\t''
dormand-prince-54\t''
implicit-euler\t''
implicit-midpoint\t''
newmark\t''
bdf2\t''
gauss-legendre-4\t''
tr-bdf2\t''
linearly-implicit-euler\t''
semi-implicit-euler-implicit-drag\t''
verlet-exact-drag\t''
exponential-rosenbrock-euler\t''
improved-euler-as-printed\t''
rk4-as-printed\t''
adaptive-euler-as-printed\t''
jakobsen-verlet\t''
lerp-per-frame\t''
lerp-dt\t''
exponential-decay\t''
smooth-damp\t''
critically-damped-spring\t''
implicit-spring\t''
engine-box2d\t''
engine-rapier\t''
engine-avian\t''
engine-avian-motor\t''
engine-jolt\t''
engine-physx\t''
engine-physx-tgs\t''
engine-physx-tgs-56\t''
engine-bullet\t''
engine-pybullet\t''
engine-chipmunk\t''
engine-mujoco\t''
engine-mujoco-rk4\t''
engine-godot\t''
engine-box3d\t''
held-force\t''"
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l seconds -d 'Seconds of real time of each run' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l latency-ms -d 'The most mean latency of what is advised' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l format -d 'How to write the rows: csv or json' -r -f -a "csv\t'Comma-separated values under a header'
json\t'An array of objects with the same names'"
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l out -d 'The file of the rows, or - for standard output' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l frames -d 'Write a line of CSV for each frame into FILE' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l plot -d 'Draw what each loop shows as PNG into FILE' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l show -d 'Print this policy as source' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l language -d 'The language of --show: rust, c++ or c#' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l force -d 'Replace the files that are there'
complete -c regatta -n "__fish_regatta_using_subcommand loop" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l tick-hz -d 'Ticks per second of the game that wrote it' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l mass -d 'The mass in kg' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l k -d 'The stiffness of the spring [default: fitted]' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l c -d 'The damping of the spring [default: fitted]' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l drag -d 'The damping setting of the body' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l thrust -d 'A constant force in newtons' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l tick-column -d 'The column of the tick\'s number' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l t-column -d 'The column of the time in seconds' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l x-column -d 'The column of the coordinate in metres' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l v-column -d 'The column of the velocity in metres per second' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l format -d 'The format: text or json' -r -f -a "text\t'Aligned columns, for people'
json\t'An array of objects, for programs'"
complete -c regatta -n "__fish_regatta_using_subcommand identify" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand port" -l want -d 'The frequency that a player is to see' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l zeta -d 'The damping ratio to be seen [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l from -d 'An engine\'s settings, a log, or a chase' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l mass -d 'The mass on the spring in kg' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l tick-hz -d 'Ticks per second of the engines, and of a log' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l substeps -d 'Substeps per tick, 1 to 1000 [default: each engine\'s own]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l to -d 'The engines (`regatta list methods`), or all' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l decimation -d 'The ticks through which a drive of user code holds its force' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l k -d 'The stiffness of the spring [default: fitted]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l c -d 'The damping of the spring [default: fitted]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l drag -d 'The damping setting of the body' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l thrust -d 'A constant force in newtons' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l tick-column -d 'The column of the tick\'s number' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l t-column -d 'The column of the time in seconds' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l x-column -d 'The column of the coordinate in metres' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l v-column -d 'The column of the velocity in metres per second' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l format -d 'The format: text or json' -r -f -a "text\t'Aligned columns, for people'
json\t'An array of objects, for programs'"
complete -c regatta -n "__fish_regatta_using_subcommand port" -l drive -d 'The limits of a drive with these gains'
complete -c regatta -n "__fish_regatta_using_subcommand port" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand show" -l as -d 'The language' -r -f -a "rust\t''
c\t''
csharp\t''
gdscript\t''"
complete -c regatta -n "__fish_regatta_using_subcommand show" -l float -d 'Numbers of single precision, as Unity and Godot have them'
complete -c regatta -n "__fish_regatta_using_subcommand show" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand chapter" -l out -d 'The directory for the figures and their data' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand chapter" -l force -d 'Replace the figures that DIR holds; other files in it stay'
complete -c regatta -n "__fish_regatta_using_subcommand chapter" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand list" -l format -d 'The format: text or json' -r -f -a "text\t'Aligned columns, for people'
json\t'An array of objects, for programs'"
complete -c regatta -n "__fish_regatta_using_subcommand list" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand completions" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand help" -s h -l help -d 'Print help (see more with \'--help\')'
