// What a person does to the page, tried in Chromium at a person's speed: fingers, keys, sharing, files, what is remembered, and a
// canvas that is taken away.

import { readFileSync } from "node:fs";

/** What a page shows, as the bytes of a picture. */
const seen = (page) => page.picture();

export async function holdDeeds({ opened, hold, becomes, seconds, tick, driven, server }) {
    await holdFingers();
    await holdSharing();
    await holdClipboard();
    await holdScrolling();
    await holdKeys();
    await holdCalm();
    await holdFolder();
    await holdFiles();
    await holdMemory();
    await holdLostContext();
    // Last, for the browser remembers that it opens the instruments.
    await holdSweep();

    async function holdFingers() {
        const phone = { width: 390, height: 844, deviceScaleFactor: 2, isMobile: true, hasTouch: true };
        const page = await opened("#scene=harbour&tick=0", phone);
        const cdp = await page.puppeteer.createCDPSession();
        const touch = async (type, ...fingers) => {
            const touchPoints = fingers.map(([x, y], id) => ({ x, y, id }));
            await cdp.send("Input.dispatchTouchEvent", { type, touchPoints });
            await seconds(0.2);
        };
        // The body is where the exact one is, a metre from the middle.
        const link = () => page.evaluate(async () => new URL((await regatta).link()).hash);
        const untouched = await link();
        await touch("touchStart", [270, 144]);
        for (const x of [230, 190, 150]) {
            await touch("touchMove", [x, 144]);
        }
        await touch("touchEnd");
        await seconds(0.5);
        const thrown = await link();
        hold(`a body is not thrown by a finger: ${untouched} and then ${thrown}`, untouched === "#scene=harbour" && thrown.startsWith("#v1."));

        const before = await seen(page);
        await touch("touchStart", [150, 400]);
        await touch("touchStart", [150, 400], [240, 400]);
        for (const apart of [20, 40, 60]) {
            await touch("touchMove", [150 - apart, 400], [240 + apart, 400]);
        }
        await touch("touchEnd");
        await seconds(0.5);
        hold("two fingers do not enlarge the stage", (await seen(page)) !== before);
        await page.close();
    }

    /** The share menu of a run that moves, by a finger and by keys alone; and the pause beside it. */
    async function holdSharing() {
        const phone = await opened("#scene=spring&method=rk4", { width: 390, height: 844, isMobile: true, hasTouch: true });
        await phone.puppeteer.tap("#share");
        await seconds(0.5);
        const [link, code] = await phone.evaluate(() => ["link", "code"].map((id) => document.getElementById(id).value));
        hold(`a run that moves is not shared by its name: ${link}`, link === `${server.address}#scene=spring&method=rk4`);
        hold(`no code for a page of one's own: ${code}`, /^<iframe src="[^"]*&amp;panels=off&amp;play" title="[^"]+"[^>]*><\/iframe>$/.test(code));
        hold("the run goes on behind the menu", await becomes(phone, async (from) => (await regatta).tick() > from, await tick(phone)));
        await phone.puppeteer.tap("#stage");
        await seconds(0.5);
        hold("a tap beside the menu leaves it open", await phone.evaluate(() => document.getElementById("sharing").hidden));
        await phone.puppeteer.tap("#pause");
        await seconds(0.5);
        const at = await tick(phone);
        await seconds(1);
        hold(`a phone does not pause at tick ${at}`, at > 0 && (await tick(phone)) === at);
        await phone.puppeteer.tap("#share");
        const still = await phone.evaluate(() => document.getElementById("link").value);
        hold(`the link of a run that stands still has no tick: ${still}`, still.endsWith(`&tick=${at}`));
        await phone.close();

        const page = await opened("#scene=spring&method=rk4&tick=30");
        await page.evaluate(() => {
            globalThis.written = [];
            navigator.clipboard.writeText = async (text) => void written.push(text);
        });
        const { keyboard } = page.puppeteer;
        const press = async (key) => {
            await keyboard.press(key, { delay: 100 });
            await seconds(0.4);
        };
        const focused = () => page.evaluate(() => document.activeElement?.id);
        for (let tabs = 0; tabs < 6 && (await focused()) !== "share"; tabs++) {
            await press("Tab");
        }
        await press("Enter");
        const isOpen = await page.evaluate(() => !document.getElementById("sharing").hidden);
        hold(`Enter on Share does not open its menu, at ${await focused()}`, isOpen && (await focused()) === "copy-link");
        await press("Space");
        const [written, said] = await page.evaluate(() => [written.join(), document.getElementById("shared").textContent]);
        hold(`Space on Copy copies ${written} and says ${said}`, written.endsWith("/#scene=spring&method=rk4&tick=30") && said.startsWith("Copied the link"));
        await press("Escape");
        hold(`Escape leads from the menu to ${await focused()}`, (await focused()) === "share");
        hold("keys of a button moved the run", (await tick(page)) === 30 && !(await page.evaluate(() => document.body.className)).includes("running"));
        await keyboard.down("Shift");
        await press("Tab");
        await keyboard.up("Shift");
        await press("Space");
        hold(`Space on Play does not start it, at ${await focused()}`, await becomes(page, async () => (await regatta).tick() > 30));
        await page.close();
    }

    /** Chords as a person presses them: the first key is down for half a second before the other. */
    async function holdClipboard() {
        const page = await opened("#scene=spring&method=rk4&tick=30");
        await driven.allow(server.address, ["clipboard-read", "clipboard-sanitized-write"]);
        const { keyboard } = page.puppeteer;
        const kept = `${server.address}#scene=pendulum&tick=12`;
        await page.evaluate((kept) => navigator.clipboard.writeText(kept), `See <${kept}>.`);
        await page.puppeteer.mouse.click(400, 300);
        for (const key of ["Control", "Shift", "CapsLock", "ContextMenu", "End"]) {
            await keyboard.down("Control");
            await seconds(0.5);
            key === "Control" || (await keyboard.press(key, { delay: 100 }));
            await keyboard.up("Control");
            await seconds(0.3);
            const found = await page.evaluate(() => navigator.clipboard.readText());
            hold(`Control and ${key} put on the clipboard: ${found.slice(0, 80)}`, found === `See <${kept}>.`);
        }
        const isAt = (hash) => document.title.includes("pendulum") && location.hash === hash;
        await keyboard.down("Control");
        await seconds(0.5);
        await keyboard.press("v", { delay: 100, commands: ["Paste"] });
        await keyboard.up("Control");
        const isOpen = await becomes(page, isAt, "#scene=pendulum&tick=12");
        hold(`a link that is pasted is not open: ${await page.evaluate(() => `${document.title} ${location.hash}`)}`, isOpen);
        hold("its tick is not shown", await becomes(page, async () => (await regatta).tick() === 12));

        // A run with a throw of its own opens in place.
        const run = await page.evaluate(async () => {
            const program = await regatta;
            dispatchEvent(new KeyboardEvent("keydown", { key: "k", code: "KeyK", bubbles: true }));
            await new Promise((later) => setTimeout(later, 1000));
            return program.link();
        });
        await page.evaluate((run) => navigator.clipboard.writeText(`${run}).`), run);
        await page.evaluate(() => history.replaceState(null, "", "#scene=spring"));
        await page.puppeteer.mouse.click(400, 300);
        await keyboard.down("Control");
        await seconds(0.5);
        await keyboard.press("v", { delay: 100, commands: ["Paste"] });
        await keyboard.up("Control");
        const isWhole = await becomes(page, (run) => location.href === run && document.title.includes("a link"), run);
        hold(`a whole run that is pasted is not in the address: ${await page.evaluate(() => `${document.title} ${location.href}`)}, ${run}`, isWhole && run.includes("#v1."));
        await page.close();
    }

    async function holdScrolling() {
        const page = await driven.open(`${server.address}questions/why-euler-explodes.html`, { height: 400 });
        const stage = await page.puppeteer.$("iframe");
        await stage.scrollIntoView();
        const { x, y, width, height } = await stage.boundingBox();
        await page.puppeteer.mouse.move(x + width / 2, y + height / 2);
        await seconds(2);
        const from = await page.evaluate(() => scrollY);
        await page.puppeteer.mouse.wheel({ deltaY: from > 0 ? -from : 100 });
        const isScrolled = await becomes(page, (from) => scrollY !== from, from);
        hold(`the page around a stage is not scrolled over it, at ${from}`, isScrolled);
        await page.close();
    }

    async function holdKeys() {
        const page = await opened("#scene=spring&method=rk4&tick=30");
        const { keyboard } = page.puppeteer;
        const focused = () => page.evaluate(() => document.activeElement?.id);
        const press = async (key) => {
            await keyboard.press(key, { delay: 80 });
            await seconds(0.3);
        };
        const seenTabs = [];
        for (let tabs = 0; tabs < 5; tabs++) {
            await press("Tab");
            seenTabs.push(await focused());
        }
        hold(`Tab goes through the page by ${seenTabs}`, seenTabs.slice(0, 4).join() === "what,pause,share,stage" && seenTabs[4] !== "stage");
        await keyboard.down("Shift");
        for (let tabs = 0; tabs < 6 && (await focused()) !== "stage"; tabs++) {
            await press("Tab");
        }
        await keyboard.up("Shift");
        const leave = () => page.evaluate(() => getComputedStyle(document.getElementById("leave")).visibility);
        const ring = () => page.evaluate(() => getComputedStyle(document.getElementById("stage")).outlineStyle);
        hold(`the stage that has the focus has no ring: ${await ring()}`, (await ring()) !== "none");
        const before = await leave();
        await press(".");
        await seconds(0.5);
        hold(`it says how to leave it: ${before} outside, ${await leave()} inside`, before === "hidden" && (await leave()) === "visible");
        hold("a key goes into the stage", (await tick(page)) === 31);
        await press("Tab");
        const from = await focused();
        await press("Escape");
        await press("Tab");
        hold(`Escape and Tab do not lead out of the stage: ${from}, ${await focused()}`, from === "stage" && (await focused()) !== "stage");
        await seconds(0.5);
        hold("it still says how to leave it", (await leave()) === "hidden");
        await page.puppeteer.mouse.click(400, 300);
        await seconds(0.5);
        hold(`a stage that was clicked has no ring: ${await ring()}`, (await ring()) !== "none" && (await leave()) === "visible");
        await page.close();
    }

    /** Whoever asks for less motion starts it, and a screen reader hears of the run where it changes. */
    async function holdCalm() {
        const page = await driven.open(`${server.address}#scene=spring`, {}, [{ name: "prefers-reduced-motion", value: "reduce" }]);
        await becomes(page, () => document.documentElement.dataset.firstFrameMs !== undefined);
        await seconds(2);
        hold(`${await tick(page)} ticks of a run that nobody has started`, (await tick(page)) === 0);
        await page.puppeteer.click("#pause");
        hold("it cannot be started", await becomes(page, async () => (await regatta).tick() > 10));
        const state = () => page.evaluate(() => document.getElementById("state").textContent);
        await becomes(page, () => document.getElementById("state").textContent.startsWith("Explicit Euler: "));
        hold(`a screen reader hears no verdict: ${await state()}`, /^Explicit Euler: grows.*Press 2/.test(await state()));
        const changes = await page.evaluate(async () => {
            let changes = 0;
            new MutationObserver((seen) => (changes += seen.length)).observe(document.getElementById("state"), { childList: true });
            await new Promise((later) => setTimeout(later, 4000));
            return changes;
        });
        hold(`it is interrupted ${changes} times in four seconds`, changes <= 1);
        await page.close();
    }

    /** The page as a file of a folder says that it needs a server. */
    async function holdFolder() {
        const complaints = driven.complaints.length;
        const page = await driven.open(`file://${process.cwd()}/target/web/index.html`);
        const isSaid = await becomes(page, () => getComputedStyle(document.getElementById("alone")).visibility === "visible");
        hold(`a folder says nothing: ${await page.evaluate(() => document.body.innerText)}`, isSaid);
        await page.close();
        // What a browser refuses of it is no fault of the page's.
        driven.complaints.length = complaints;
    }

    async function holdSweep() {
        const page = await opened("#scene=spring", { width: 1280, height: 936 });
        await page.puppeteer.keyboard.press("e");
        await seconds(1);
        const still = await seen(page);
        // The button beside the stiffness, which then changes with each frame for eight seconds.
        await page.puppeteer.mouse.click(965, 428);
        await seconds(1);
        const from = await tick(page);
        await seconds(3);
        const ticks = (await tick(page)) - from;
        hold(`${ticks} ticks in three seconds of a parameter that is swept`, ticks > 45 && ticks < 400);
        hold("the inspector shows no sweep", (await seen(page)) !== still);
        await page.close();
    }

    async function holdFiles() {
        const page = await opened("");
        const text = readFileSync("assets/scenes/ship.toml", "utf8");
        await page.evaluate((text) => {
            const dataTransfer = new DataTransfer();
            dataTransfer.items.add(new File([text], "dropped.toml"));
            dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
        }, text);
        const isOpen = await becomes(page, () => document.title.includes("dropped"));
        hold(`a scene that was dropped is not open: ${await page.evaluate(() => document.title)}`, isOpen);
        await page.close();
    }

    async function holdMemory() {
        const page = await opened("");
        await page.puppeteer.keyboard.press("t");
        await seconds(10);
        const bytes = () => page.evaluate(async () => (await regatta).memory.buffer.byteLength);
        const from = await bytes();
        await seconds(20);
        hold(`memory grows from ${from} to ${await bytes()}`, (await bytes()) - from < 4e6);
        // What is open is remembered when the page is left.
        await page.evaluate(() => document.dispatchEvent(new Event("visibilitychange")));
        const kept = await page.evaluate(() => localStorage.regatta ?? "");
        hold(`not remembered that instruments are open: ${kept}`, /measure = true/.test(kept));
        await page.evaluate(() => localStorage.clear());
        await page.close();
    }

    async function holdLostContext() {
        const page = await opened("#scene=spring&method=rk4");
        await seconds(3);
        const from = await tick(page);
        await page.evaluate(() => {
            document.documentElement.dataset.isLost = "";
            document.getElementById("stage").getContext("webgl2").getExtension("WEBGL_lose_context").loseContext();
        });
        // The page first puts its state into its address, and then loads again.
        await becomes(page, () => {
            const { isLost, firstFrameMs } = document.documentElement.dataset;
            return isLost === undefined && firstFrameMs !== undefined;
        });
        const link = await page.evaluate(() => location.hash);
        const goesOn = await becomes(page, async (from) => (await regatta).tick() > from, from);
        hold(`a lost canvas does not come back at tick ${from}: ${link}`, /^#scene=spring&method=rk4&tick=\d+&play$/.test(link) && goesOn);
        await page.close();
    }
}
