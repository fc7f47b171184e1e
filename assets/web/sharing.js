// Offers the run as a link, as code for a page of one's own, and to what the system shares by.

const menu = document.getElementById("sharing");
const button = document.getElementById("share");
const link = document.getElementById("link");
const code = document.getElementById("code");
const send = document.getElementById("send");
const shared = document.getElementById("shared");

/** A text as the value of an attribute. */
const quoted = (text) => text.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;");

/** The code that shows the run of an address on another page: a run that waits at a tick waits there too. */
function frame(address) {
    const source = `${address}&panels=off${address.includes("&tick=") ? "" : "&play"}`;
    return `<iframe src="${quoted(source)}" title="${quoted(document.title)}" width="640" height="360" style="border: 0" loading="lazy" allow="clipboard-write; web-share"></iframe>`;
}

async function copy(field, what) {
    try {
        await navigator.clipboard.writeText(field.value);
        shared.textContent = `Copied the ${what}: ${field.value.length} characters.`;
    } catch {
        field.focus();
        field.select();
        shared.textContent = `This browser keeps the clipboard to itself. The ${what} is selected: copy it with Ctrl C.`;
    }
}

function close() {
    menu.hidden = true;
    button.setAttribute("aria-expanded", "false");
}

export function offerSharing(program) {
    const open = () => {
        menu.hidden = false;
        button.setAttribute("aria-expanded", "true");
        shared.textContent = "";
        try {
            link.value = program.link();
            code.value = frame(link.value);
        } catch (reason) {
            link.value = code.value = "";
            shared.textContent = `${reason}`;
        }
        for (const of of menu.querySelectorAll("input, label, button")) {
            of.hidden = !link.value;
        }
        send.hidden = !link.value || !navigator.canShare?.({ url: link.value });
        document.getElementById("copy-link").focus();
    };
    button.addEventListener("click", () => (menu.hidden ? open() : close()));
    document.getElementById("copy-link").addEventListener("click", () => copy(link, "link"));
    document.getElementById("copy-code").addEventListener("click", () => copy(code, "code"));
    // Whoever sends it to nobody has changed their mind.
    send.addEventListener("click", () => navigator.share({ title: document.title, url: link.value }).catch(() => {}));
    addEventListener("keydown", (event) => {
        if (event.key === "Escape" && !menu.hidden) {
            close();
            button.focus();
        }
    });
    addEventListener("pointerdown", ({ target }) => {
        if (!menu.contains(target) && target !== button) {
            close();
        }
    });
}
