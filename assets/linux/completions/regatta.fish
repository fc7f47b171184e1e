# Print an optspec for argparse to handle cmd's options that are independent of any subcommand.
function __fish_regatta_global_optspecs
    string join \n scene= k= c= frequency= damping-ratio= mass= method= impact= tick-hz= step= race loop= seconds= record= force theme= renderer= reduced-motion h/help V/version
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
spring\t''
ship\t''
damped\t''
pendulum\t''
stiff\t''
surge\t''
chain\t''
helm\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''
liouville\t''
kicked-rotor\t''
orbit\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
ball\t''
perpetual\t''
pong\t''
landing\t''
rope\t''
cloth\t''
bridge\t''"
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
complete -c regatta -n "__fish_regatta_needs_command" -l impact -d 'A rule for impacts of a ball, or several' -r -f -a "locate\t''
velocity\t''
velocity-blind\t''
clamp\t''
mirror\t''
energy\t''
before-tick\t''
locate-cubic\t''
locate-chord\t''
swept\t''
swept-step\t''
penalty\t''"
complete -c regatta -n "__fish_regatta_needs_command" -l tick-hz -d 'Ticks per second [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_needs_command" -l step -d 'The length of a tick, in place of --tick-hz' -r
complete -c regatta -n "__fish_regatta_needs_command" -l loop -d 'Open the loop lab on a trace [default: edge]' -r
complete -c regatta -n "__fish_regatta_needs_command" -l seconds -d 'Close after these simulated seconds' -r
complete -c regatta -n "__fish_regatta_needs_command" -l record -d 'Write the run to FILE as a scene' -r -F
complete -c regatta -n "__fish_regatta_needs_command" -l theme -d 'The theme: dark or light' -r -f -a "dark\t''
light\t''"
complete -c regatta -n "__fish_regatta_needs_command" -l renderer -d 'What draws: auto, gpu or cpu [default: auto]' -r -f -a "auto\t''
gpu\t''
cpu\t''"
complete -c regatta -n "__fish_regatta_needs_command" -l race -d 'Race all methods of the scene at once'
complete -c regatta -n "__fish_regatta_needs_command" -l force -d 'Replace the --record FILE if it exists'
complete -c regatta -n "__fish_regatta_needs_command" -l reduced-motion -d 'Trails do not fade, and the camera zooms out in steps'
complete -c regatta -n "__fish_regatta_needs_command" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_needs_command" -s V -l version -d 'Print version'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "play" -d 'Open the window (also without `play`)'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "capture" -d 'Draw a run into numbered pictures, without a window'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "verify" -d 'Run a capture or a recording again and say what has changed'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "trace" -d 'Write the exact motion and every method\'s, tick by tick'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "advise" -d 'Recommend a method and its substeps for a scene at its tick rate'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "sweep" -d 'Run every method at every tick rate on every scene, a row each'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "cloud" -d 'Step a cloud of starting points and measure its area'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "loop" -d 'Measure what game loops do to motion on a display'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "identify" -d 'Say which engine or method made a log of a motion'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "port" -d 'Print settings that make a spring move the same in every engine'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "rule" -d 'Show how your own lines move at every frame rate'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "show" -d 'Print a method or a game loop as code for your game'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "fixture" -d 'Write exact states as a test for your own engine'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "diff" -d 'Say where two runs first differ'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "link" -d 'Print a run as a link'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "chapter" -d 'Print the chapter\'s tables, and draw its Figures 7-2 to 7-8'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "list" -d 'List scenes, methods, bodies, metrics, policies, traces or keys'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "mcp" -d 'Answer an assistant by the Model Context Protocol'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "completions" -d 'Print a completion script for a shell'
complete -c regatta -n "__fish_regatta_needs_command" -f -a "help" -d 'Print this help, help on a command, or a chapter of the manual'
complete -c regatta -n "__fish_regatta_using_subcommand play" -l scene -d 'A scene or the file of one [default: harbour]' -r -f -a "harbour\t''
spring\t''
ship\t''
damped\t''
pendulum\t''
stiff\t''
surge\t''
chain\t''
helm\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''
liouville\t''
kicked-rotor\t''
orbit\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
ball\t''
perpetual\t''
pong\t''
landing\t''
rope\t''
cloth\t''
bridge\t''"
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
complete -c regatta -n "__fish_regatta_using_subcommand play" -l impact -d 'A rule for impacts of a ball, or several' -r -f -a "locate\t''
velocity\t''
velocity-blind\t''
clamp\t''
mirror\t''
energy\t''
before-tick\t''
locate-cubic\t''
locate-chord\t''
swept\t''
swept-step\t''
penalty\t''"
complete -c regatta -n "__fish_regatta_using_subcommand play" -l tick-hz -d 'Ticks per second [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand play" -l step -d 'The length of a tick, in place of --tick-hz' -r
complete -c regatta -n "__fish_regatta_using_subcommand play" -l loop -d 'Open the loop lab on a trace [default: edge]' -r
complete -c regatta -n "__fish_regatta_using_subcommand play" -l seconds -d 'Close after these simulated seconds' -r
complete -c regatta -n "__fish_regatta_using_subcommand play" -l record -d 'Write the run to FILE as a scene' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand play" -l theme -d 'The theme: dark or light' -r -f -a "dark\t''
light\t''"
complete -c regatta -n "__fish_regatta_using_subcommand play" -l renderer -d 'What draws: auto, gpu or cpu [default: auto]' -r -f -a "auto\t''
gpu\t''
cpu\t''"
complete -c regatta -n "__fish_regatta_using_subcommand play" -l race -d 'Race all methods of the scene at once'
complete -c regatta -n "__fish_regatta_using_subcommand play" -l force -d 'Replace the --record FILE if it exists'
complete -c regatta -n "__fish_regatta_using_subcommand play" -l reduced-motion -d 'Trails do not fade, and the camera zooms out in steps'
complete -c regatta -n "__fish_regatta_using_subcommand play" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l scene -d 'A scene or the file of one [default: harbour]' -r -f -a "harbour\t''
spring\t''
ship\t''
damped\t''
pendulum\t''
stiff\t''
surge\t''
chain\t''
helm\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''
liouville\t''
kicked-rotor\t''
orbit\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
ball\t''
perpetual\t''
pong\t''
landing\t''
rope\t''
cloth\t''
bridge\t''"
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
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l impact -d 'A rule for impacts of a ball, or several' -r -f -a "locate\t''
velocity\t''
velocity-blind\t''
clamp\t''
mirror\t''
energy\t''
before-tick\t''
locate-cubic\t''
locate-chord\t''
swept\t''
swept-step\t''
penalty\t''"
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l tick-hz -d 'Ticks per second [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l step -d 'The length of a tick, in place of --tick-hz' -r
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
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l instrument -d 'The instrument [default: motion]' -r -f -a "motion\t''
error\t''
energy\t''
phase\t''
stability-map\t''
one-step\t''
cloud\t''
advice\t''
loop\t''
cost\t''"
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l shape -d 'The shape of the starts of the instrument cloud' -r -f -a "cat\t''
disc\t''
ring\t''"
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l renderer -d 'What draws: auto, gpu or cpu [default: cpu]' -r -f -a "auto\t''
gpu\t''
cpu\t''"
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l mark-every -d 'Ticks between two states in the manifest' -r
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l format -d 'The format: png, gif, y4m or sheet' -r -f -a "png\t'Numbered pictures and a manifest in a directory'
gif\t'One GIF, each frame with its own palette'
y4m\t'YUV4MPEG2, for a video encoder'
sheet\t'One picture, time across, lanes down'"
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l race -d 'Race all methods of the scene at once'
complete -c regatta -n "__fish_regatta_using_subcommand capture" -l force -d 'Replace the frames in DIR, or FILE'
complete -c regatta -n "__fish_regatta_using_subcommand capture" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand verify" -l report -d 'Also write the result to FILE, as junit or json' -r
complete -c regatta -n "__fish_regatta_using_subcommand verify" -l diff -d 'Draw the difference of each changed frame into DIR' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand verify" -l max-channel -d 'The largest allowed difference of a channel, 0 to 255' -r
complete -c regatta -n "__fish_regatta_using_subcommand verify" -l max-pixels -d 'The largest allowed percentage of pixels off by more than 1' -r
complete -c regatta -n "__fish_regatta_using_subcommand verify" -l physics-only -d 'Judge only the physics'
complete -c regatta -n "__fish_regatta_using_subcommand verify" -l bless -d 'Accept the present results'
complete -c regatta -n "__fish_regatta_using_subcommand verify" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l scene -d 'A scene or the file of one [default: harbour]' -r -f -a "harbour\t''
spring\t''
ship\t''
damped\t''
pendulum\t''
stiff\t''
surge\t''
chain\t''
helm\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''
liouville\t''
kicked-rotor\t''
orbit\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
ball\t''
perpetual\t''
pong\t''
landing\t''
rope\t''
cloth\t''
bridge\t''"
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
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l impact -d 'A rule for impacts of a ball, or several' -r -f -a "locate\t''
velocity\t''
velocity-blind\t''
clamp\t''
mirror\t''
energy\t''
before-tick\t''
locate-cubic\t''
locate-chord\t''
swept\t''
swept-step\t''
penalty\t''"
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l tick-hz -d 'Ticks per second [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l step -d 'The length of a tick, in place of --tick-hz' -r
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l seconds -d 'Simulated seconds [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l every -d 'Write only the ticks that are multiples of N' -r
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l format -d 'How to write it: csv or json' -r -f -a "csv\t'Comma-separated values under a header'
json\t'An array of objects with the same names'"
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l metrics -d 'Write each metric too (`regatta list metrics`)'
complete -c regatta -n "__fish_regatta_using_subcommand trace" -l impacts -d 'Write a row for each impact of a ball in place of the ticks'
complete -c regatta -n "__fish_regatta_using_subcommand trace" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l scene -d 'A scene or the file of one [default: harbour]' -r -f -a "harbour\t''
spring\t''
ship\t''
damped\t''
pendulum\t''
stiff\t''
surge\t''
chain\t''
helm\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''
liouville\t''
kicked-rotor\t''
orbit\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
ball\t''
perpetual\t''
pong\t''
landing\t''
rope\t''
cloth\t''
bridge\t''"
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
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l impact -d 'A rule for impacts of a ball, or several' -r -f -a "locate\t''
velocity\t''
velocity-blind\t''
clamp\t''
mirror\t''
energy\t''
before-tick\t''
locate-cubic\t''
locate-chord\t''
swept\t''
swept-step\t''
penalty\t''"
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l tick-hz -d 'Ticks per second [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l step -d 'The length of a tick, in place of --tick-hz' -r
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l family -d 'Judge only the methods of this family' -r -f -a "explicit\t''
symplectic\t''
adaptive\t''
implicit\t''
linearised\t''
as-printed\t''
follower\t''
engine\t''"
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l as -d 'Print the recommended method as code too' -r -f -a "rust\t''
c\t''
csharp\t''
gdscript\t''
javascript\t''
lua\t''"
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l format -d 'The format: text or json' -r -f -a "text\t'Aligned columns, for people'
json\t'An array of objects, for programs'"
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l rates -d 'Also find the slowest tick rates'
complete -c regatta -n "__fish_regatta_using_subcommand advise" -l all -d 'Print all tables'
complete -c regatta -n "__fish_regatta_using_subcommand advise" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l scene -d 'A scene, or several [default: all built-in ones]' -r -f -a "harbour\t''
spring\t''
ship\t''
damped\t''
pendulum\t''
stiff\t''
surge\t''
chain\t''
helm\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''
liouville\t''
kicked-rotor\t''
orbit\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
ball\t''
perpetual\t''
pong\t''
landing\t''
rope\t''
cloth\t''
bridge\t''"
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
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l impact -d 'The rule for impacts of every ball (`regatta list impacts`) [default: the scene\'s]' -r -f -a "locate\t''
velocity\t''
velocity-blind\t''
clamp\t''
mirror\t''
energy\t''
before-tick\t''
locate-cubic\t''
locate-chord\t''
swept\t''
swept-step\t''
penalty\t''"
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l tick-hz -d 'Tick rates in Hz, separated by commas' -r
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l step -d 'Lengths of a tick in seconds, in place of --tick-hz' -r
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l vary -d 'Values of a parameter: a row for each' -r
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l seconds -d 'Simulated seconds of each run' -r
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l format -d 'How to write it: csv or json' -r -f -a "csv\t'Comma-separated values under a header'
json\t'An array of objects with the same names'"
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l threads -d 'Threads, 1 to 256 [default: one for each core]' -r
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l out -d 'The file of the rows, or - for standard output' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l plot -d 'Draw work-precision diagrams as PNG into FILE' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l round-off -d 'Also draw the round-off of f32 and f64'
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -l force -d 'Replace the files that are there'
complete -c regatta -n "__fish_regatta_using_subcommand sweep" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l scene -d 'A scene or the file of one [default: harbour]' -r -f -a "harbour\t''
spring\t''
ship\t''
damped\t''
pendulum\t''
stiff\t''
surge\t''
chain\t''
helm\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''
liouville\t''
kicked-rotor\t''
orbit\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
ball\t''
perpetual\t''
pong\t''
landing\t''
rope\t''
cloth\t''
bridge\t''"
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
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l impact -d 'A rule for impacts of a ball, or several' -r -f -a "locate\t''
velocity\t''
velocity-blind\t''
clamp\t''
mirror\t''
energy\t''
before-tick\t''
locate-cubic\t''
locate-chord\t''
swept\t''
swept-step\t''
penalty\t''"
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l tick-hz -d 'Ticks per second [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l step -d 'The length of a tick, in place of --tick-hz' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l points -d 'Starts, 1 to 1000000000' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l shape -d 'The shape of the starts: cat, disc or ring' -r -f -a "cat\t''
disc\t''
ring\t''"
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l reach -d 'The reach of the shape' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l seconds -d 'Simulated seconds of the run' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l threads -d 'Threads, 1 to 256 [default: one for each core]' -r
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l format -d 'How to write it: csv or json' -r -f -a "csv\t'Comma-separated values under a header'
json\t'An array of objects with the same names'"
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l out -d 'The file of the rows, or - for standard output' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -l force -d 'Replace the file if it is there'
complete -c regatta -n "__fish_regatta_using_subcommand cloud" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l policy -d 'A policy, or several [default: the usual ones]' -r -f -a "variable\t''
lockstep\t''
clamped-variable\t''
semi-fixed\t''
fixed\t''
fixed-linear\t''
fixed-hermite\t''
fixed-extrapolated\t''
render-tick\t''
whole-refresh\t''
snapped\t''
hysteresis\t''
median\t''
slow-down\t''
arcade\t''
babylon-lockstep\t''
bevy\t''
cannon-es\t''
colyseus-timer\t''
excalibur\t''
excalibur-max60\t''
fixedstep\t''
framesync\t''
godot\t''
gsap\t''
gsap-fps60\t''
kaplay-fixed\t''
kivy-interval\t''
kontra\t''
littlejs\t''
love\t''
mainloop-js\t''
matter-runner\t''
melonjs\t''
p2-es\t''
panda3d-bullet\t''
phaser\t''
phaser-arcade\t''
phaser-arcade-limit60\t''
phaser-limit60\t''
pixi\t''
pixi-max60\t''
playcanvas\t''
pygame-tick\t''
pyglet-interval\t''
r3-rapier\t''
three-timer\t''
unity\t''
unreal\t''"
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l engine -d 'The loop of your engine, with what it does to your game in three lines' -r -f -a "arcade\t''
babylon-lockstep\t''
bevy\t''
cannon-es\t''
colyseus-timer\t''
excalibur\t''
excalibur-max60\t''
fixedstep\t''
framesync\t''
godot\t''
gsap\t''
gsap-fps60\t''
kaplay-fixed\t''
kivy-interval\t''
kontra\t''
littlejs\t''
love\t''
mainloop-js\t''
matter-runner\t''
melonjs\t''
p2-es\t''
panda3d-bullet\t''
phaser\t''
phaser-arcade\t''
phaser-arcade-limit60\t''
phaser-limit60\t''
pixi\t''
pixi-max60\t''
playcanvas\t''
pygame-tick\t''
pyglet-interval\t''
r3-rapier\t''
three-timer\t''
unity\t''
unreal\t''"
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l set -d 'A constant of the loop\'s lines, such as max_ticks=4' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l cost-ms -d 'What a tick costs, for loops that count it [default: nothing]' -r
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
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l frame-column -d 'The column of the times of frames, by name or number' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l clock-column -d 'The column of a running clock, in place of times' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l unit -d 'The unit of the times: ns, us, ms, s or ticks [default: found]' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l tick-column -d 'The column of the tick\'s number [default: tick]' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l t-column -d 'The column of the time [default: t]' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l x-column -d 'The column of the coordinate in metres [default: x]' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l v-column -d 'The column of the velocity in metres per second [default: v]' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l start -d 'Take the rows from this time on, counted from the first row' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l end -d 'Take the rows before this time, counted from the first row' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l rows -d 'Take these rows, such as 3001..8447' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l where -d 'Take the rows whose cell in COLUMN is VALUE' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l separator -d 'The separator of the cells: a character, tab or space [default: found]' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l shown -d 'The column of the log with the moment that a frame shows, which is a row of its own' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l speed -d 'The speed of the column of --shown in units a second [default: fitted]' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l tick-hz -d 'Ticks per second [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l step -d 'The length of a tick, in place of --tick-hz' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l display-hz -d 'The refresh rate [default: the trace\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l fps -d 'Frames per second of a game with even frames [default: the display\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l max-ticks -d 'The most ticks in a frame [default: each loop\'s own]' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l excess -d 'Whether later frames make the ticks beyond the most of a frame: drop or keep' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l long-frame -d 'What a long frame counts as, before any other limit' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l max-frame-ms -d 'The longest frame that is simulated [default: each loop\'s own]' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l scene -d 'A scene or the file of one' -r -f -a "harbour\t''
spring\t''
ship\t''
damped\t''
pendulum\t''
stiff\t''
surge\t''
chain\t''
helm\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''
liouville\t''
kicked-rotor\t''
orbit\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
ball\t''
perpetual\t''
pong\t''
landing\t''
rope\t''
cloth\t''
bridge\t''"
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
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l latency-ms -d 'The most mean latency that the advised loop may have' -r
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l format -d 'How to write the rows: csv or json' -r -f -a "csv\t'Comma-separated values under a header'
json\t'An array of objects with the same names'"
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l out -d 'The file of the rows, or - for standard output' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l frame-rows -d 'Write a line of CSV for each frame into FILE' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l plot -d 'Draw the motion of each loop as PNG into FILE' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l all -d 'Compare all policies'
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l engines -d 'Compare the loops of all engines'
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l no-header -d 'The first line is already a row'
complete -c regatta -n "__fish_regatta_using_subcommand loop" -l force -d 'Replace the files that are there'
complete -c regatta -n "__fish_regatta_using_subcommand loop" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l tick-hz -d 'Ticks per second of the game that wrote it [default: by the times]' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l step -d 'The length of a tick, in place of --tick-hz' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l mass -d 'The mass in kg' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l k -d 'The stiffness of the spring [default: fitted]' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l c -d 'The damping of the spring [default: fitted]' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l drag -d 'The damping setting of the body' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l rest -d 'Where the spring rests, in metres [default: 0, or fitted]' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l v0 -d 'The velocity of the first row, where v was not logged [default: fitted]' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l thrust -d 'A constant force in newtons' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l frame-column -d 'The column of the times of frames, by name or number' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l clock-column -d 'The column of a running clock, in place of times' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l unit -d 'The unit of the times: ns, us, ms, s or ticks [default: found]' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l tick-column -d 'The column of the tick\'s number [default: tick]' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l t-column -d 'The column of the time [default: t]' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l x-column -d 'The column of the coordinate in metres [default: x]' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l v-column -d 'The column of the velocity in metres per second [default: v]' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l start -d 'Take the rows from this time on, counted from the first row' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l end -d 'Take the rows before this time, counted from the first row' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l rows -d 'Take these rows, such as 3001..8447' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l where -d 'Take the rows whose cell in COLUMN is VALUE' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l separator -d 'The separator of the cells: a character, tab or space [default: found]' -r
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l format -d 'The format: text or json' -r -f -a "text\t'Aligned columns, for people'
json\t'An array of objects, for programs'"
complete -c regatta -n "__fish_regatta_using_subcommand identify" -l no-header -d 'The first line is already a row'
complete -c regatta -n "__fish_regatta_using_subcommand identify" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand port" -l frequency -d 'The frequency that a player should see' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l damping-ratio -d 'The damping ratio that a player should see [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l from -d 'The settings of an engine or a user interface, a log, or a chase' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l mass -d 'The mass on the spring in kg' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l tick-hz -d 'Ticks per second of the engines and of a log, frames per second of user interfaces' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l step -d 'The length of a tick, in place of --tick-hz' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l substeps -d 'Substeps per tick, 1 to 1000 [default: each engine\'s own]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l to -d 'Engines and user interfaces, all engines, or all of the others: ui' -r -f -a "all\t''
ui\t''
engine-box2d\t''
engine-rapier\t''
engine-avian\t''
engine-avian-motor\t''
engine-jolt\t''
engine-physx\t''
engine-physx-tgs\t''
engine-physx-tgs-56\t''
engine-bullet\t''
engine-chipmunk\t''
engine-mujoco\t''
engine-mujoco-rk4\t''
engine-godot\t''
engine-box3d\t''
held-force\t''
swiftui\t''
swiftui-response\t''
core-animation\t''
css\t''
compose\t''
android\t''
flutter\t''
flutter-duration\t''
react-spring\t''
motion\t''
motion-duration\t''
slint\t''
gpui\t''
popmotion\t''
react-native\t''
react-native-bounciness\t''
react-native-stiffness\t''
reanimated\t''
reanimated-duration\t''
remotion\t''
anime\t''
wobble\t''
svelte\t''
solid\t''
libadwaita\t''
niri\t''
hyprland\t''
qt\t''
unity-smooth-damp\t''
per-frame\t''"
complete -c regatta -n "__fish_regatta_using_subcommand port" -l decimation -d 'How many ticks a drive in user code holds its force' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l k -d 'The stiffness of the spring [default: fitted]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l c -d 'The damping of the spring [default: fitted]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l drag -d 'The damping setting of the body' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l rest -d 'Where the spring rests, in metres [default: 0, or fitted]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l v0 -d 'The velocity of the first row, where v was not logged [default: fitted]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l thrust -d 'A constant force in newtons' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l frame-column -d 'The column of the times of frames, by name or number' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l clock-column -d 'The column of a running clock, in place of times' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l unit -d 'The unit of the times: ns, us, ms, s or ticks [default: found]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l tick-column -d 'The column of the tick\'s number [default: tick]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l t-column -d 'The column of the time [default: t]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l x-column -d 'The column of the coordinate in metres [default: x]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l v-column -d 'The column of the velocity in metres per second [default: v]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l start -d 'Take the rows from this time on, counted from the first row' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l end -d 'Take the rows before this time, counted from the first row' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l rows -d 'Take these rows, such as 3001..8447' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l where -d 'Take the rows whose cell in COLUMN is VALUE' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l separator -d 'The separator of the cells: a character, tab or space [default: found]' -r
complete -c regatta -n "__fish_regatta_using_subcommand port" -l format -d 'The format: text or json' -r -f -a "text\t'Aligned columns, for people'
json\t'An array of objects, for programs'"
complete -c regatta -n "__fish_regatta_using_subcommand port" -l ends -d 'When each user interface ends the motion, and how much of the way is left then'
complete -c regatta -n "__fish_regatta_using_subcommand port" -l drive -d 'The limits of a drive with these gains'
complete -c regatta -n "__fish_regatta_using_subcommand port" -l no-header -d 'The first line is already a row'
complete -c regatta -n "__fish_regatta_using_subcommand port" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand rule" -l fps -d 'The frames per second for which they were written' -r
complete -c regatta -n "__fish_regatta_using_subcommand rule" -l dt -d 'The unit of dt in the lines: s, ms or us' -r -f -a "s\t''
ms\t''
us\t''"
complete -c regatta -n "__fish_regatta_using_subcommand rule" -l within -d 'The fraction of the way, or of the speed, within which it has settled: 0.01 if left out' -r
complete -c regatta -n "__fish_regatta_using_subcommand rule" -l as -d 'The language of the code: rust, c, cpp, csharp, gdscript, javascript or lua' -r -f -a "rust\t''
c\t''
csharp\t''
gdscript\t''
javascript\t''
lua\t''
cpp\t''"
complete -c regatta -n "__fish_regatta_using_subcommand rule" -l format -d 'The format: text or json' -r -f -a "text\t'Aligned columns, for people'
json\t'An array of objects, for programs'"
complete -c regatta -n "__fish_regatta_using_subcommand rule" -l scene -d 'Print a scene instead, which races the lines at half, once and twice that rate'
complete -c regatta -n "__fish_regatta_using_subcommand rule" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand show" -l as -d 'The language: rust, c, cpp, csharp, gdscript, javascript, lua or step' -r -f -a "rust\t''
c\t''
csharp\t''
gdscript\t''
javascript\t''
lua\t''
cpp\t''
step\t''"
complete -c regatta -n "__fish_regatta_using_subcommand show" -l float -d 'Use single precision, as Unity and Godot do'
complete -c regatta -n "__fish_regatta_using_subcommand show" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand fixture" -l scene -d 'A scene or the file of one [default: harbour]' -r -f -a "harbour\t''
spring\t''
ship\t''
damped\t''
pendulum\t''
stiff\t''
surge\t''
chain\t''
helm\t''
alike\t''
engines\t''
held-force\t''
stiff-in-engines\t''
liouville\t''
kicked-rotor\t''
orbit\t''
follow\t''
lerp\t''
duffing\t''
quarter-car\t''
bouncing-bungee\t''
lift\t''
jump\t''
ball\t''
perpetual\t''
pong\t''
landing\t''
rope\t''
cloth\t''
bridge\t''"
complete -c regatta -n "__fish_regatta_using_subcommand fixture" -l k -d 'A spring of this stiffness in place of a scene' -r
complete -c regatta -n "__fish_regatta_using_subcommand fixture" -l c -d 'The damping of the spring of --k [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand fixture" -l frequency -d 'A spring of this frequency in place of a scene' -r
complete -c regatta -n "__fish_regatta_using_subcommand fixture" -l damping-ratio -d 'The damping of that spring [default: 0]' -r
complete -c regatta -n "__fish_regatta_using_subcommand fixture" -l mass -d 'The mass on the spring [default: 1]' -r
complete -c regatta -n "__fish_regatta_using_subcommand fixture" -l method -d 'A method (`regatta list methods`), or several' -r -f -a "explicit-euler\t''
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
complete -c regatta -n "__fish_regatta_using_subcommand fixture" -l impact -d 'A rule for impacts of a ball, or several' -r -f -a "locate\t''
velocity\t''
velocity-blind\t''
clamp\t''
mirror\t''
energy\t''
before-tick\t''
locate-cubic\t''
locate-chord\t''
swept\t''
swept-step\t''
penalty\t''"
complete -c regatta -n "__fish_regatta_using_subcommand fixture" -l tick-hz -d 'Ticks per second [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand fixture" -l step -d 'The length of a tick, in place of --tick-hz' -r
complete -c regatta -n "__fish_regatta_using_subcommand fixture" -l seconds -d 'Simulated seconds [default: the scene\'s]' -r
complete -c regatta -n "__fish_regatta_using_subcommand fixture" -l every -d 'Write only the ticks that are multiples of N' -r
complete -c regatta -n "__fish_regatta_using_subcommand fixture" -l as -d 'What to write: pytest, gtest, rust or json' -r -f -a "pytest\t''
gtest\t''
rust\t''
json\t''"
complete -c regatta -n "__fish_regatta_using_subcommand fixture" -l float -d 'Use single precision, as Unity and Godot do'
complete -c regatta -n "__fish_regatta_using_subcommand fixture" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l ulps -d 'Numbers at most N doubles apart are equal' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l relative -d 'Numbers that differ by at most this fraction of the larger are equal' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l key -d 'The columns that match rows [default: tick,lane,body,coordinate]' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l columns -d 'Compare these columns only' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l ignore -d 'Do not compare these columns' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l frame-column -d 'The column of the times of frames, by name or number' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l clock-column -d 'The column of a running clock, in place of times' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l unit -d 'The unit of the times: ns, us, ms, s or ticks [default: found]' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l tick-column -d 'The column of the tick\'s number [default: tick]' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l t-column -d 'The column of the time [default: t]' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l x-column -d 'The column of the coordinate in metres [default: x]' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l v-column -d 'The column of the velocity in metres per second [default: v]' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l start -d 'Take the rows from this time on, counted from the first row' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l end -d 'Take the rows before this time, counted from the first row' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l rows -d 'Take these rows, such as 3001..8447' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l where -d 'Take the rows whose cell in COLUMN is VALUE' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l separator -d 'The separator of the cells: a character, tab or space [default: found]' -r
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l format -d 'The format: text or json' -r -f -a "text\t'Aligned columns, for people'
json\t'An array of objects, for programs'"
complete -c regatta -n "__fish_regatta_using_subcommand diff" -l no-header -d 'The first line is already a row'
complete -c regatta -n "__fish_regatta_using_subcommand diff" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand link" -l format -d 'The format: text or json' -r -f -a "text\t'Aligned columns, for people'
json\t'An array of objects, for programs'"
complete -c regatta -n "__fish_regatta_using_subcommand link" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand chapter" -l out -d 'The directory for the figures and their data' -r -F
complete -c regatta -n "__fish_regatta_using_subcommand chapter" -l format -d 'The format: text or json' -r -f -a "text\t'Aligned columns, for people'
json\t'An array of objects, for programs'"
complete -c regatta -n "__fish_regatta_using_subcommand chapter" -l force -d 'Replace the figures that DIR holds; other files in it stay'
complete -c regatta -n "__fish_regatta_using_subcommand chapter" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand list" -l format -d 'The format: text or json' -r -f -a "text\t'Aligned columns, for people'
json\t'An array of objects, for programs'"
complete -c regatta -n "__fish_regatta_using_subcommand list" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand mcp" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand completions" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c regatta -n "__fish_regatta_using_subcommand help" -s h -l help -d 'Print help (see more with \'--help\')'
