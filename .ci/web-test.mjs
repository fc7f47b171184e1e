#!/usr/bin/env node
// Holds target/web and target/regatta.html, which .ci/web --single makes, to the program: the bits of every scene under every method, the words of verdicts, the
// numbers of the pages of questions, a stage that is drawn, and time that runs as in the world. `.ci/web-test.mjs firefox` and
// `.ci/web-test.mjs webkit` take these browsers instead of Chromium, in which alone touch, a lost context and files are tried.
// Needs the browser, and npm, which installs the driver under target/tools; WebKit is GTK's MiniBrowser with WebKitWebDriver.
// These two need a display, as xvfb-run has one. Exits 2 where something is missing, and 3 where the browser goes no further,
// as when one of its processes has crashed.

import { existsSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { pathToFileURL } from "node:url";
import { drive } from "./web-browser.mjs";
import { serve } from "./web-server.mjs";

const browser = process.argv[2] ?? "chrome";
if (!existsSync("target/web/regatta_web_bg.wasm") || !existsSync("target/regatta.html")) {
    console.error("missing: target/web or target/regatta.html; run .ci/web --single");
    process.exit(2);
}
const server = await serve("target/web");
const driven = await drive(browser);

let passed = 0;
const failures = [];
function hold(what, holds) {
    holds ? passed++ : failures.push(what);
}
const seconds = (many) => new Promise((later) => setTimeout(later, 1000 * many));

/** Waits until what is asked of a page is true, for a minute. Returns whether it was. */
async function becomes(page, asked, ...given) {
    for (let tries = 0; tries < 240; tries++) {
        // While a page loads there is nobody to ask.
        if (await page.evaluate(asked, ...given).catch(() => false)) {
            return true;
        }
        await seconds(0.25);
    }
    return false;
}

/** The page of an address, once its first frame is drawn. */
async function opened(address, size) {
    const page = await driven.open(server.address + address, size);
    const drawn = await becomes(page, () => document.documentElement.dataset.firstFrameMs !== undefined);
    hold(`${address}: no first frame: ${await page.evaluate(() => document.getElementById("told").textContent)}`, drawn);
    return page;
}

/** How many colours a picture of the page has. */
async function colours(page) {
    return page.evaluate(async (picture) => {
        const image = new Image();
        image.src = `data:image/png;base64,${picture}`;
        await image.decode();
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [image.width, image.height];
        const context = canvas.getContext("2d");
        context.drawImage(image, 0, 0);
        const { data } = context.getImageData(0, 0, image.width, image.height);
        return new Set(new Uint32Array(data.buffer)).size;
    }, await page.picture());
}

/** How far a picture of the page's stage is from a still one, which the program has drawn: the mean difference of a channel as a
 * part of the whole range; and how far that still one is from one of a single colour. */
async function differences(page, still) {
    return page.evaluate(async (picture, still) => {
        const pixels = async (source, top = 0) => {
            const image = new Image();
            image.src = source;
            await image.decode();
            const canvas = document.createElement("canvas");
            [canvas.width, canvas.height] = [image.width, image.height - top];
            const context = canvas.getContext("2d");
            context.drawImage(image, 0, -top);
            return context.getImageData(0, 0, canvas.width, canvas.height).data;
        };
        // Above the stage the page has a bar, and below it its methods.
        const { top } = document.getElementById("stage").getBoundingClientRect();
        const [drawn, wanted] = [await pixels(`data:image/png;base64,${picture}`, top), await pixels(still)];
        const mean = [0, 1, 2, 3].map((channel) => wanted.reduce((sum, it, at) => sum + (at % 4 === channel ? it : 0), 0) / (wanted.length / 4));
        const far = (other) => wanted.reduce((sum, it, at) => sum + Math.abs(it - other(at)), 0) / (wanted.length * 255);
        return [far((at) => drawn[at]), far((at) => mean[at % 4])];
    }, await page.picture(), still);
}

const tick = (page) => page.evaluate(async () => (await regatta).tick());
/** Ticks, frames and seconds, all at one moment, for each question waits for a frame. */
const moment = (page) =>
    page.evaluate(async () => {
        const run = await regatta;
        return [run.tick(), run.frames(), performance.now() / 1000];
    });

/** That ticks pass as in the world, and a stage on another's page waits until it is told. */
async function holdTime() {
    let page = await opened("");
    const firstFrameMs = await page.evaluate(() => document.documentElement.dataset.firstFrameMs);
    const seen = await colours(page);
    hold(`the stage is drawn: ${seen} colours`, seen > 100);
    let [rate, frameRate] = [0, 0];
    for (let tries = 0; tries < 5 && !(rate > 59 && rate < 61 && frameRate > 3); tries++) {
        if (tries > 0) {
            // Where something else keeps the machine busy, ticks are dropped for a while; and after 20 s the run ends.
            await page.close();
            page = await opened("");
        }
        await seconds(2);
        const from = await moment(page);
        await seconds(8);
        const until = await moment(page);
        const [ticks, drawn, passed] = until.map((it, i) => it - from[i]);
        [rate, frameRate] = [ticks / passed, drawn / passed];
    }
    hold(`ticks a second: ${rate}`, rate > 59 && rate < 61);
    hold(`frames a second: ${frameRate}`, frameRate > 3);
    console.log(`first frame after ${firstFrameMs} ms, ${seen} colours, ${rate.toFixed(1)} ticks and ${frameRate.toFixed(1)} frames a second`);
    await page.close();

    const stands = await opened("#panels=off&theme=dark", { height: 540 + 36 });
    hold("a stage on another's page waits", (await tick(stands)) === 0);
    const [off, blank] = await differences(stands, "still-dark.webp");
    hold(`its picture is off the program's by ${off}, one without a motif by ${blank}`, off < 0.015 && blank > 3 * off);
    console.log(`${(100 * off).toFixed(2)} % off the program's picture`);
    await stands.close();
}

/** That every scene has the bits of the program under every method, and verdicts its words. */
async function holdBitsAndWords() {
    const page = await opened("#panels=off");
    const hashes = readFileSync("tests/early_hashes.txt", "utf8");
    const words = readFileSync("tests/judged_words.txt", "utf8");
    const of = (kept, scene) => kept.split("\n").filter((line) => line.startsWith(`${scene} `)).join("\n") + "\n";
    const scenes = (kept) => new Set(kept.split("\n").filter(Boolean).map((line) => line.split(" ")[0]));
    for (const scene of scenes(hashes)) {
        const [found, still] = await page.evaluate(async (scene) => (await regatta).early_hashes(scene), scene);
        const wanted = of(hashes, scene);
        hold(`${scene}: the bits are others:\n${found}instead of\n${wanted}`, found === wanted);
        hold(`${scene}: nothing moved`, found !== still);
        console.log(`${scene}: ${found.split("\n").length - 1} methods`);
    }
    for (const scene of scenes(words)) {
        const found = await page.evaluate(async (scene) => (await regatta).judged_words(scene), scene);
        const wanted = of(words, scene);
        hold(`${scene}: the words are others:\n${found}instead of\n${wanted}`, found === wanted);
    }
    console.log(`${scenes(words).size} scenes judged`);
    await page.close();
}

/** That the processor draws the golden pictures here too. Letters alone are filled by vectors that round otherwise on the machine
 * that kept them. */
async function holdFrames() {
    const page = await opened("#panels=off");
    if (!(await page.evaluate(async () => (await regatta).golden_race !== undefined))) {
        console.log("no frames by the processor: .ci/web web-dev makes a page that has them");
        return page.close();
    }
    for (const scene of ["spring", "harbour", "pendulum", "orbit", "engines"]) {
        const golden = readFileSync(`tests/golden/${scene}-race.png`).toString("base64");
        const [pixels, off, worst] = await page.evaluate(async (scene, golden) => {
            const image = new Image();
            image.src = `data:image/png;base64,${golden}`;
            await image.decode();
            const canvas = document.createElement("canvas");
            [canvas.width, canvas.height] = [image.width, image.height];
            const context = canvas.getContext("2d");
            context.drawImage(image, 0, 0);
            const kept = context.getImageData(0, 0, image.width, image.height).data;
            const drawn = (await regatta).golden_race(scene);
            const differences = Array.from(kept, (level, at) => Math.abs(level - drawn[at]));
            const changed = new Set(differences.flatMap((difference, at) => (difference > 0 ? [at >> 2] : [])));
            return [drawn.length / 4, changed.size, differences.reduce((most, difference) => Math.max(most, difference), 0)];
        }, scene, golden);
        hold(`${scene}: ${off} of ${pixels} pixels are off, the worst by ${worst}`, pixels === 400 * 225 && off <= 9 && worst <= 2);
        console.log(`${scene}: ${off} of ${pixels} pixels off the golden picture, the worst by ${worst}`);
    }
    await page.close();
}

/** That each page of questions computes the numbers of its text, below stages that move. */
async function holdQuestions() {
    const index = await driven.open(`${server.address}questions/`);
    const links = await index.evaluate(() => [...document.querySelectorAll("li a")].map((link) => link.href));
    hold(`pages of questions: ${links.length}`, links.length >= 6);
    await index.close();
    for (const link of links) {
        const page = await driven.open(link);
        const count = await page.evaluate(() => document.querySelectorAll("figure").length);
        hold(`${link}: no claim`, count > 0);
        for (let figure = 0; figure < count; figure++) {
            await page.evaluate((figure) => document.querySelectorAll("figure")[figure].scrollIntoView(), figure);
            const is = (figure) => !document.querySelectorAll(".computed")[figure].hidden;
            const isThere = await becomes(page, is, figure);
            const [claim, number, computed] = await page.evaluate((figure) => {
                const { dataset, firstElementChild } = document.querySelectorAll(".computed")[figure];
                return [dataset.claim, dataset.number, firstElementChild.textContent];
            }, figure);
            hold(`${claim}: ${computed} here, ${number} in the text`, isThere && computed === number);
            // In the loop lab it is not the run that moves.
            const isBeyond = async (figure, from) => {
                const { contentWindow, src } = document.querySelectorAll("iframe")[figure];
                const program = await contentWindow.regatta;
                const moment = src.includes("loop=") ? program.frames() : program.tick();
                return from === undefined ? moment : moment > from;
            };
            const from = await page.evaluate(isBeyond, figure);
            hold(`${claim}: its stage stands still`, await becomes(page, isBeyond, figure, from));
        }
        console.log(`${link.split("/").at(-1)}: ${count} numbers`);
        await page.close();
    }
}

/** That each page says in its head what it is where a link to it is shared, with a picture that is there. */
function holdHeads() {
    const pages = ["", "questions"].flatMap((folder) =>
        readdirSync(join("target/web", folder)).filter((name) => name.endsWith(".html")).map((name) => join("target/web", folder, name)));
    hold(`pages: ${pages.length}`, pages.length >= 10);
    const titles = new Set();
    for (const page of pages) {
        const text = readFileSync(page, "utf8");
        const meta = (name) => text.match(new RegExp(`<meta (?:name|property)="${name}" content="([^"]*)"`))?.[1] ?? "";
        const there = (path) => existsSync(/^https?:/.test(path) ? join("target/web/previews", path.split("/").at(-1)) : join(dirname(page), path));
        const [title, said] = [meta("og:title"), meta("og:description")];
        titles.add(title);
        hold(`${page}: its title is ${title}`, title.length > 5 && title === meta("twitter:title"));
        hold(`${page}: it says ${said}`, said.length > 40 && said.length < 200 && said === meta("twitter:description") && meta("description").length > 40);
        hold(`${page}: its picture is ${meta("og:image")}`, meta("og:image") === meta("twitter:image") && there(meta("og:image")));
        hold(`${page}: no colour, icon or card`, /^#/.test(meta("theme-color")) && there(text.match(/<link rel="icon" href="([^"]*)"/)?.[1] ?? "none") && meta("twitter:card") === "summary_large_image");
        hold(`${page}: something is not filled in`, !/\{\{|[{}]/.test(text));
    }
    hold(`titles: ${[...titles].join()}`, titles.size === pages.length);
}

/** That an address which leads nowhere keeps still and says so in the middle, and one that was coded or has an end of a sentence
 * behind it leads where it should. */
async function holdAddresses() {
    const said = (page) => page.evaluate(() => document.getElementById("told").textContent);
    for (const [address, word] of [["#scen=spring", "scene"], ["#scene=tub", "tub"], ["#scene=spring&method=rk5", "rk4"], ["#v1.AAAA", "copy it whole"]]) {
        const page = await driven.open(server.address + address);
        await becomes(page, () => document.documentElement.classList.contains("refused"));
        hold(`${address}: it says ${await said(page)}`, (await said(page)).includes(word));
        const [middle, height, links] = await page.evaluate(() => {
            const { top, bottom } = document.getElementById("told").getBoundingClientRect();
            const links = [...document.querySelectorAll("#else a")].filter((link) => link.checkVisibility()).length;
            return [(top + bottom) / 2, innerHeight, links];
        });
        hold(`${address}: it says so at ${middle} of ${height}, with ${links} links`, Math.abs(middle / height - 0.5) < 0.12 && links === 3);
        hold(`${address}: something runs`, await page.evaluate(() => document.documentElement.dataset.firstFrameMs === undefined));
        if (address.startsWith("#scen=")) {
            // As when the address is mended in place.
            await page.evaluate(() => void (location.hash = "#scene=spring"));
            hold("a mended address does not open", await becomes(page, () => document.title.includes("spring") && document.documentElement.dataset.firstFrameMs !== undefined));
        }
        await page.close();
    }
    for (const address of ["#scene%3Dspring%26method%3Drk4", "#scene=spring&method=rk4).", "#scene=spring&method=rk4%3E,"]) {
        const page = await opened(address);
        const title = await page.evaluate(() => document.title);
        hold(`${address}: ${title}`, title.includes("spring") && title.includes("Runge-Kutta 4"));
        hold(`${address}: its question is elsewhere`, await page.evaluate(() => document.getElementById("what").href.endsWith("questions/which-tick-rate.html")));
        await page.close();
    }
}

/** That the page in one file runs from a disk, with the same bits. */
async function holdSingle() {
    const page = await driven.open(pathToFileURL("target/regatta.html").href);
    hold("one file: no first frame", await becomes(page, () => document.documentElement.dataset.firstFrameMs !== undefined));
    const links = await page.evaluate(() => document.querySelectorAll("a[href]:not([href^='#'])").length);
    hold(`one file: ${links} links to pages that are not in it`, links === 0);
    const kept = readFileSync("tests/early_hashes.txt", "utf8").split("\n");
    for (const scene of ["two-springs", "ship", "pendulum"]) {
        const [found] = await page.evaluate(async (scene) => (await regatta).early_hashes(scene), scene);
        const wanted = kept.filter((line) => line.startsWith(`${scene} `)).join("\n") + "\n";
        hold(`one file, ${scene}: the bits are others:\n${found}instead of\n${wanted}`, found === wanted);
    }
    const from = await tick(page);
    hold("one file: time stands still", await becomes(page, async (from) => (await regatta).tick() > from, from));
    await page.close();
}

/** That a server whose policy forbids the program is told what to allow. */
async function holdPolicy() {
    const complaints = driven.complaints.length;
    const strict = await serve("target/web", { headers: { "Content-Security-Policy": "default-src 'self'" } });
    const page = await driven.open(strict.address);
    await becomes(page, () => document.documentElement.classList.contains("refused"));
    const said = await page.evaluate(() => document.getElementById("told").textContent);
    hold(`under a strict policy it says ${said}`, said.includes("'wasm-unsafe-eval'") && !said.includes("again"));
    await page.close();
    strict.close();
    // The browser complains of the policy.
    driven.complaints.length = complaints;
}

try {
    holdHeads();
    await holdTime();
    await holdAddresses();
    await holdPolicy();
    await holdSingle();
    await holdQuestions();
    await holdBitsAndWords();
    await holdFrames();
    if (browser === "chrome") {
        const { holdDeeds } = await import("./web-deeds.mjs");
        await holdDeeds({ opened, hold, becomes, seconds, tick, driven, server });
    }
    hold(`complaints: ${driven.complaints.join("; ")}`, driven.complaints.length === 0);
    hold(`not found: ${server.missing.join(", ")}`, server.missing.length === 0);
} catch (reason) {
    // Not 1, for a process of a browser may end by itself, and then what was asked of its page meanwhile does not hold.
    console.error(`${browser} goes no further: ${reason.stack ?? reason}`);
    process.exitCode = 3;
} finally {
    await driven.close().catch((reason) => console.error(`${browser} does not close: ${reason}`));
    server.close();
}
failures.forEach((failure) => console.error(`FAILED ${failure}`));
console.log(`${passed} passed, ${failures.length} failed`);
process.exit(process.exitCode ?? (failures.length ? 1 : 0));
