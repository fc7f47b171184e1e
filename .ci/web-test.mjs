#!/usr/bin/env node
// Holds target/web, which .ci/web makes, to the program: the bits of every scene under every method, a stage that is drawn, and
// time that runs as in the world. `.ci/web-test.mjs firefox` takes that browser instead of Chromium. Needs one of them, and npm,
// which installs the driver under target/tools; exits 2 where something is missing.

import { execFileSync } from "node:child_process";
import { createReadStream, existsSync, readFileSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, join } from "node:path";

process.chdir(join(import.meta.dirname, ".."));
const browsers = { chrome: ["chromium", "google-chrome"], firefox: ["firefox-esr", "firefox"] };
const browser = process.argv[2] ?? "chrome";
const paths = (process.env.PATH ?? "").split(":");
const executablePath = browsers[browser]
    ?.flatMap((name) => paths.map((path) => join(path, name)))
    .find((path) => existsSync(path));
if (!executablePath || !existsSync("target/web/regatta_web_bg.wasm")) {
    console.error(`missing: ${executablePath ? "target/web; run .ci/web" : `a browser for ${browser}`}`);
    process.exit(2);
}

const tools = "target/tools/node";
if (!existsSync(join(tools, "node_modules/puppeteer-core"))) {
    execFileSync("npm", ["install", "--silent", "--prefix", tools, "puppeteer-core@24"], { stdio: "inherit" });
}
const puppeteer = createRequire(join(process.cwd(), tools, "package.json"))("puppeteer-core").default;

const kinds = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };
const server = createServer((request, response) => {
    const path = new URL(request.url, "http://localhost").pathname.replace(/\/$/, "/index.html");
    const file = join("target/web", path);
    if (!existsSync(file) || !statSync(file).isFile()) {
        response.writeHead(404).end();
        return;
    }
    response.writeHead(200, { "Content-Type": kinds[extname(file)] ?? "application/octet-stream" });
    createReadStream(file).pipe(response);
});
await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
const address = `http://127.0.0.1:${server.address().port}/`;

const chromium = ["--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync"];
const driven = await puppeteer.launch({ browser, executablePath, args: browser === "chrome" ? chromium : [] });

let passed = 0;
const failures = [];
function hold(what, holds) {
    holds ? passed++ : failures.push(what);
}

/** The page, once its first frame is drawn, and what it complained of. */
async function opened(fragment) {
    const page = await driven.newPage();
    await page.setViewport({ width: 960, height: 540 });
    const complaints = [];
    page.on("pageerror", (error) => complaints.push(error.message));
    page.on("requestfailed", (request) => complaints.push(`not found: ${request.url()}`));
    await page.goto(address + fragment);
    await page.waitForFunction("document.documentElement.dataset.firstFrameMs", { timeout: 120_000 });
    return { page, complaints };
}

/** How many colours a picture of the page has. */
async function colours(page) {
    const picture = await page.screenshot({ encoding: "base64" });
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
    }, picture);
}

const tick = (page) => page.evaluate(async () => (await import("./regatta_web.js")).tick());

try {
    const { page, complaints } = await opened("");
    const seen = await colours(page);
    hold(`the stage is drawn: ${seen} colours`, seen > 100);
    await new Promise((later) => setTimeout(later, 3000));
    const [from, began] = [await tick(page), performance.now()];
    await new Promise((later) => setTimeout(later, 5000));
    const rate = (1000 * (await tick(page) - from)) / (performance.now() - began);
    hold(`ticks a second: ${rate}`, rate > 58 && rate < 62);
    console.log(`${seen} colours, ${rate.toFixed(1)} ticks a second`);

    const stands = (await opened("#panels=off")).page;
    hold("a stage on another's page waits", (await tick(stands)) === 0);
    await stands.close();

    const kept = readFileSync("tests/early_hashes.txt", "utf8");
    for (const scene of new Set(kept.split("\n").filter(Boolean).map((line) => line.split(" ")[0]))) {
        const [found, still] = await page.evaluate(
            async (scene) => (await import("./regatta_web.js")).early_hashes(scene), scene);
        const wanted = kept.split("\n").filter((line) => line.startsWith(`${scene} `)).join("\n") + "\n";
        hold(`${scene}: the bits are others:\n${found}instead of\n${wanted}`, found === wanted);
        hold(`${scene}: nothing moved`, found !== still);
        console.log(`${scene}: ${found.split("\n").length - 1} methods`);
    }
    hold(`complaints: ${complaints.join("; ")}`, complaints.length === 0);
} finally {
    await driven.close();
    server.close();
}
failures.forEach((failure) => console.error(`FAILED ${failure}`));
console.log(`${passed} passed, ${failures.length} failed`);
process.exit(failures.length ? 1 : 0);
