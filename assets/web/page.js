// Loads the program, tells how far it is, and starts it.

import init, { start } from "./regatta_web.js";

const loaded = document.getElementById("loaded");
const told = document.getElementById("told");
const wait = document.getElementById("wait");

/** What keeps the page from being one, in its middle. */
function tell(sentence) {
    told.textContent = sentence;
    loaded.hidden = true;
    wait.hidden = false;
}

/** The program, compiled while it arrives; its bytes are counted as the browser hands them on, uncompressed. */
async function program() {
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

/** The length of the program; `.ci/web` writes it. */
const BYTES = 1;

addEventListener("error", (event) => tell(`Regatta has stopped (${event.message}). Load the page again.`));
try {
    await init({ module_or_path: program() });
    await start();
    wait.hidden = true;
    document.documentElement.dataset.firstFrameMs = Math.round(performance.now());
} catch (reason) {
    tell(`${reason.message ?? reason}`);
}
