// Serves a folder of static files on this machine, compressed where the browser takes that, and notes what it does not have.

import { readFileSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { brotliCompressSync, constants } from "node:zlib";

const kinds = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".webp": "image/webp", ".jpg": "image/jpeg", ".svg": "image/svg+xml" };

export async function serve(folder, { quality = 1, headers: own = {} } = {}) {
    const missing = [];
    const packed = new Map();
    const server = createServer((request, response) => {
        const path = new URL(request.url, "http://localhost").pathname.replace(/\/$/, "/index.html");
        const file = join(folder, path);
        if (!statSync(file, { throwIfNoEntry: false })?.isFile()) {
            missing.push(path);
            response.writeHead(404).end();
            return;
        }
        const headers = { "Content-Type": kinds[extname(file)] ?? "application/octet-stream", "Cache-Control": "max-age=60", ...own };
        if (/\bbr\b/.test(request.headers["accept-encoding"] ?? "")) {
            const pack = () => brotliCompressSync(readFileSync(file), {
                params: { [constants.BROTLI_PARAM_QUALITY]: quality, [constants.BROTLI_PARAM_LGWIN]: 24 },
            });
            packed.has(file) || packed.set(file, pack());
            response.writeHead(200, { ...headers, "Content-Encoding": "br" }).end(packed.get(file));
        } else {
            response.writeHead(200, headers).end(readFileSync(file));
        }
    });
    await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
    return { address: `http://127.0.0.1:${server.address().port}/`, missing, close: () => server.close() };
}
