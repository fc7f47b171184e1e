// What a person does to the page, tried in Chromium: fingers, keys, files, what is remembered, and a canvas that is taken away.

import { readFileSync } from "node:fs";

/** What a page shows, as the bytes of a picture. */
const seen = (page) => page.picture();

export async function holdDeeds({ opened, hold, becomes, seconds, tick, driven, server }) {
    await holdFingers();
    await holdSharing();
    await holdScrolling();
    await holdKeys();
    await holdFiles();
    await holdMemory();
    await holdLostContext();
    // Last, for the browser remembers that it opens the instruments.
    await holdSweep();

    async function holdFingers() {
        const phone = { width: 390, height: 844, deviceScaleFactor: 2, isMobile: true, hasTouch: true };
        const page = await opened("#tick=0", phone);
        const cdp = await page.puppeteer.createCDPSession();
        const touch = async (type, ...fingers) => {
            const touchPoints = fingers.map(([x, y], id) => ({ x, y, id }));
            await cdp.send("Input.dispatchTouchEvent", { type, touchPoints });
            await seconds(0.2);
        };
        // The body is where the exact one is, a metre from the middle.
        const link = async (before) => {
            await page.puppeteer.keyboard.down("Control");
            await page.puppeteer.keyboard.press("l");
            await page.puppeteer.keyboard.up("Control");
            await becomes(page, (before) => location.hash.startsWith("#v1.") && location.hash !== before, before);
            return page.evaluate(() => location.hash);
        };
        const untouched = await link();
        await touch("touchStart", [270, 108]);
        for (const x of [230, 190, 150]) {
            await touch("touchMove", [x, 108]);
        }
        await touch("touchEnd");
        await seconds(0.5);
        const thrown = await link(untouched);
        hold(`a body is not thrown by a finger: ${untouched} and then ${thrown}`, thrown.length > untouched.length);

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

    async function holdSharing() {
        const page = await opened("#scene=spring&method=rk4&tick=30", { width: 390, height: 844, isMobile: true, hasTouch: true });
        const isPaused = await becomes(page, () => getComputedStyle(document.getElementById("share")).display === "block");
        await page.puppeteer.tap("#share");
        const isShared = await becomes(page, () => location.hash.startsWith("#v1."));
        hold(`a run is not shared by a button: ${isPaused}, ${isShared}`, isPaused && isShared);
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
        const focused = () => page.evaluate(() => document.activeElement?.id);
        await page.evaluate(() => document.getElementById("stage").focus());
        await page.puppeteer.keyboard.press("Tab");
        const from = await focused();
        await page.puppeteer.keyboard.press("Escape");
        await page.puppeteer.keyboard.press("Tab");
        hold(`Escape and Tab do not lead out of the stage: ${from}, ${await focused()}`, from === "stage" && (await focused()) !== "stage");
        await page.close();
    }

    async function holdSweep() {
        const page = await opened("#scene=spring", { width: 1280, height: 900 });
        await page.puppeteer.keyboard.press("e");
        await seconds(1);
        const still = await seen(page);
        // The button beside the stiffness, which then changes with each frame for eight seconds.
        await page.puppeteer.mouse.click(965, 392);
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
        const again = page.puppeteer.waitForNavigation({ timeout: 60_000 });
        await page.evaluate(() => document.getElementById("stage").getContext("webgl2").getExtension("WEBGL_lose_context").loseContext());
        await again;
        await becomes(page, () => document.documentElement.dataset.firstFrameMs !== undefined);
        const link = await page.evaluate(() => location.hash);
        const goesOn = await becomes(page, async (from) => (await regatta).tick() > from, from);
        hold(`a lost canvas does not come back at tick ${from}: ${link}`, /^#v1\..*&tick=\d+&play/.test(link) && goesOn);
        await page.close();
    }
}
