// Loads the program, tells how far it is, and starts it.

import { offerSharing } from "./sharing.js";

const loaded = document.getElementById("loaded");
const told = document.getElementById("told");
const wait = document.getElementById("wait");
const still = document.getElementById("still");
const stage = document.getElementById("stage");

document.getElementById("alone").remove();

/** Whether it stands on a page of the same site, whose text is about it. */
function isQuoted() {
    try {
        return self !== top && parent.location.origin === location.origin;
    } catch {
        return false;
    }
}

// On another page it is a stage alone.
document.getElementById("else").hidden = self !== top;
document.documentElement.classList.toggle("embedded", self !== top);
document.documentElement.classList.toggle("quoted", isQuoted());
// The still picture is of the scene that opens by itself.
still.hidden = location.hash.length > 1 && !/^#(panels=\w+|play|theme=\w+|&)*$/.test(location.hash);

// Another run in the address of the same page.
addEventListener("hashchange", () => location.reload());

/** Says why there is no stage, or none any more. */
function tell(sentence) {
    told.textContent = sentence;
    loaded.hidden = true;
    still.hidden = true;
    wait.hidden = false;
    document.getElementById("begin").hidden = location.hash.length < 2;
    document.documentElement.classList.add("refused");
}

/** Where the two parts of the program come from. A page in one file has them in it. */
const parts = globalThis.parts ?? {
    bound: () => import("./regatta_web.js"),
    program: () => fetch("regatta_web_bg.wasm"),
};

/** The bytes of the program as they arrive, from which it is compiled; they are counted uncompressed, as the browser hands them on. */
async function arriving() {
    const response = await parts.program();
    if (!response.ok) {
        throw new Error(`The server says ${response.status} of regatta_web_bg.wasm: the page is not whole.`);
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

/** Why the program did not start, for people. */
function why(reason) {
    const words = `${reason.message ?? reason}`;
    // Each browser has an error of its own for it, and all of them name the policy.
    if (/content.security.policy|\bCSP\b|unsafe-eval/i.test(words)) {
        return "The server's Content-Security-Policy forbids the program: its script-src needs 'self' and 'wasm-unsafe-eval'.";
    }
    return reason instanceof WebAssembly.CompileError
        ? `The program has not arrived whole (${words}). Load the page again.`
        : words;
}

/** A button that is clicked leaves the keys to the stage; one that is pressed keeps them. */
function onPress(id, does) {
    document.getElementById(id).addEventListener("click", (event) => {
        does();
        event.detail > 0 && stage.focus({ preventScroll: true });
    });
}

/** What stands around a stage on another page can ask the program once its first frame is drawn. */
globalThis.regatta = (async () => {
    if (!WebAssembly.validate(new Uint8Array(VECTORS))) {
        throw new Error("Regatta needs WebAssembly with vectors, as browsers have it since 2023.");
    }
    const { default: init, ...program } = await parts.bound().catch(() => {
        throw new Error("A part of the program has not arrived (regatta_web.js). Load the page again.");
    });
    const { memory } = await init({ module_or_path: arriving() });
    await program.start();
    wait.hidden = true;
    document.documentElement.dataset.firstFrameMs = Math.round(performance.now());
    onPress("pause", program.pause);
    onPress("play", program.pause);
    offerSharing(program);
    // Scrolled out of sight on that page, a stage stands still.
    const sight = new IntersectionObserver((seen) => program.set_in_sight(seen.at(-1).isIntersecting));
    sight.observe(stage);
    return { ...program, memory };
})();
regatta.catch((reason) => tell(why(reason)));
