// Drives a browser: Chromium and Firefox by puppeteer-core, WebKit by WebDriver. A page has `evaluate`, `picture` and `close`.

import { execFileSync, spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

process.chdir(join(import.meta.dirname, ".."));
const SIZE = { width: 960, height: 540 };

/** The first of these programs that is there, or an end of the test. */
function program(...names) {
    const paths = (process.env.PATH ?? "").split(":");
    const found = names.flatMap((name) => (name.startsWith("/") ? [name] : paths.map((path) => join(path, name))));
    const path = found.find((path) => existsSync(path));
    if (!path) {
        console.error(`missing: ${names[0]}`);
        process.exit(2);
    }
    return path;
}

async function byPuppeteer(browser, executablePath) {
    const tools = "target/tools/node";
    if (!existsSync(join(tools, "node_modules/puppeteer-core"))) {
        execFileSync("npm", ["install", "--silent", "--prefix", tools, "puppeteer-core@24"], { stdio: "inherit" });
    }
    const puppeteer = createRequire(join(process.cwd(), tools, "package.json"))("puppeteer-core").default;
    const chromium = ["--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
        "--disable-background-networking", "--disable-component-update", "--disable-sync"];
    const args = browser === "chrome" ? chromium : [];
    // Without a window Firefox has no driver for WebGL in software.
    const headless = browser === "chrome";
    const driven = await puppeteer.launch({ browser, executablePath, args, headless, protocolTimeout: 600_000 });
    const complaints = [];
    return {
        complaints,
        /** Lets pages of an address do what a person is else asked for. */
        allow: (address, permissions) => driven.defaultBrowserContext().overridePermissions(new URL(address).origin, permissions),
        async open(address, size = SIZE, features = []) {
            const page = await driven.newPage();
            await page.setViewport({ ...SIZE, ...size });
            features.length && (await page.emulateMediaFeatures(features));
            page.on("pageerror", (error) => complaints.push(`${address}: ${error.message}`));
            page.on("console", (said) => said.type() === "error" && complaints.push(`${address}: ${said.text()}`));
            page.on("requestfailed", (asked) => {
                // A page that is loaded again asks no more for what it asked for.
                const isGivenUp = /ERR_ABORTED|NS_BINDING_ABORTED/.test(asked.failure()?.errorText ?? "");
                isGivenUp || complaints.push(`${address}: not found: ${asked.url()}`);
            });
            page.on("request", (asked) => {
                // A file has no origin, and asks for itself alone.
                const isOwn = asked.url().startsWith(address.startsWith("file:") ? address : new URL(address).origin) || /^(data|blob|about):/.test(asked.url());
                isOwn || complaints.push(`${address}: asks ${asked.url()}`);
            });
            await page.goto(address);
            return {
                puppeteer: page,
                evaluate: (asked, ...given) => page.evaluate(asked, ...given),
                picture: () => page.screenshot({ encoding: "base64" }),
                close: () => page.close(),
            };
        },
        close: () => driven.close(),
    };
}

async function byWebDriver(driver, binary) {
    const port = 20_000 + (process.pid % 10_000);
    const driving = spawn(driver, [`--port=${port}`], { stdio: "inherit" });
    const ask = async (method, path, asked) => {
        const body = asked && JSON.stringify(asked);
        const answer = await fetch(`http://127.0.0.1:${port}/session${path}`, { method, body });
        const { value } = await answer.json();
        if (!answer.ok) {
            throw new Error(`${path}: ${value.message}`);
        }
        return value;
    };
    const options = { binary, args: ["--automation"] };
    const capabilities = { alwaysMatch: { "webkitgtk:browserOptions": options, timeouts: { script: 600_000 } } };
    const begin = async (tries) => {
        try {
            return await ask("POST", "", { capabilities });
        } catch (reason) {
            if (tries === 0) {
                driving.kill();
                throw reason;
            }
            await new Promise((later) => setTimeout(later, 500));
            return begin(tries - 1);
        }
    };
    const { sessionId } = await begin(20);
    const window = (method, path, asked) => ask(method, `/${sessionId}${path}`, asked);
    return {
        complaints: [],
        // One window, whose page each address takes the place of.
        async open(address, size = SIZE) {
            const wanted = { ...SIZE, ...size };
            await window("POST", "/window/rect", wanted);
            // An address that differs by its fragment alone is no other page.
            await window("POST", "/url", { url: "about:blank" });
            // A window is larger than the page in it.
            const script = "return { width: outerWidth - innerWidth, height: outerHeight - innerHeight }";
            const border = await window("POST", "/execute/sync", { script, args: [] });
            await window("POST", "/window/rect", { width: wanted.width + border.width, height: wanted.height + border.height });
            await window("POST", "/url", { url: address });
            return {
                async evaluate(asked, ...given) {
                    const script = `const [given, done] = arguments;
                        Promise.resolve((${asked})(...given)).then((is) => done({ is: is ?? null }), (not) => done({ not: String(not) }));`;
                    const { is, not } = await window("POST", "/execute/async", { script, args: [given] });
                    if (not) {
                        throw new Error(not);
                    }
                    return is;
                },
                picture: () => window("GET", "/screenshot"),
                close: () => {},
            };
        },
        async close() {
            try {
                await window("DELETE", "");
            } finally {
                driving.kill();
            }
        },
    };
}

const browsers = {
    chrome: () => byPuppeteer("chrome", program("chromium", "google-chrome")),
    firefox: () => byPuppeteer("firefox", program("firefox-esr", "firefox")),
    webkit: () => {
        const folder = execFileSync("sh", ["-c", "ls -d /usr/lib/*/webkit2gtk-4.1 2>/dev/null | head -n 1"]);
        return byWebDriver(program("WebKitWebDriver"), program(`${folder}`.trim() + "/MiniBrowser"));
    },
};

export function drive(browser) {
    if (browser !== "chrome" && !process.env.DISPLAY && !process.env.WAYLAND_DISPLAY) {
        console.error(`missing: a display; xvfb-run -a .ci/web-test.mjs ${browser}`);
        process.exit(2);
    }
    if (!browsers[browser]) {
        console.error(`no browser ${browser}; there are ${Object.keys(browsers).join(", ")}`);
        process.exit(2);
    }
    return browsers[browser]();
}
