// Shows beside each number of the text what the program in the stage below it computes.

for (const figure of document.querySelectorAll("figure")) {
    const frame = figure.querySelector("iframe");
    const computed = figure.querySelector(".computed");
    const again = figure.querySelector(".again");

    const show = async () => {
        // Until it is near, a frame holds an empty page.
        const program = await frame.contentWindow.regatta?.catch(() => undefined);
        if (!program || !computed.hidden) {
            return;
        }
        const number = program.number(computed.dataset.claim);
        computed.querySelector("output").textContent = number;
        computed.classList.add(number === computed.dataset.number ? "same" : "other");
        computed.hidden = false;
        again.hidden = false;
        again.addEventListener("click", async () => (await frame.contentWindow.regatta).restart());
    };
    frame.addEventListener("load", show);
    // A stage may have been there before this script.
    show();
}
