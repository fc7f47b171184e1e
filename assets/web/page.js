// Loads the program, tells how far it is, and starts it.

const loaded = document.getElementById("loaded");
const told = document.getElementById("told");
const wait = document.getElementById("wait");
const still = document.getElementById("still");

// On another page it is a stage alone.
document.getElementById("else").hidden = self !== top;
document.documentElement.classList.toggle("embedded", self !== top);
// The still picture is of the scene that opens by itself.
still.hidden = /[#&]v\d|scene=|loop=/.test(location.hash);

/** Says why there is no stage, or none any more. */
function tell(sentence) {
    told.textContent = sentence;
    loaded.hidden = true;
    still.hidden = true;
    wait.hidden = false;
}

/** The bytes of the program as they arrive, from which it is compiled; they are counted uncompressed, as the browser hands them on. */
async function arriving() {
    const response = await fetch("regatta_web_bg.wasm");
    if (!response.ok) {
        throw new Error(`the server says ${response.status} of regatta_web_bg.wasm`);
    }
    let bytes = 0;
    const counted = new TransformStream({
        transform(part, rest) {
            bytes += part.length;
            loaded.value = bytes / BYTES;
            rest.enqueue(part);
        },
    });
    const headers = { "Content-Type": "application/wasm" };
    return new Response(response.body.pipeThrough(counted), { headers });
}

/** The least program that computes with vectors. */
const VECTORS = [0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11];

/** The length of the program; `.ci/web` writes it. */
const BYTES = 1;

addEventListener("error", (event) => tell(`Regatta has stopped (${event.message}). Load the page again.`));

/** What stands around a stage on another page can ask the program once its first frame is drawn. */
globalThis.regatta = (async () => {
    if (!WebAssembly.validate(new Uint8Array(VECTORS))) {
        throw new Error("Regatta needs WebAssembly with vectors, as browsers have it since 2023.");
    }
    const { default: init, ...program } = await import("./regatta_web.js");
    const { memory } = await init({ module_or_path: arriving() });
    await program.start();
    wait.hidden = true;
    document.documentElement.dataset.firstFrameMs = Math.round(performance.now());
    // Scrolled out of sight on that page, a stage stands still.
    const sight = new IntersectionObserver((seen) => program.set_in_sight(seen.at(-1).isIntersecting));
    sight.observe(document.getElementById("stage"));
    return { ...program, memory };
})();
regatta.catch((reason) => tell(reason instanceof WebAssembly.CompileError
    ? `The program has not arrived whole (${reason.message}). Load the page again.`
    : `${reason.message ?? reason}`));
