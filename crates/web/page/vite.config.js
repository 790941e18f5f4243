// One HTML file: code and style by vite-plugin-singlefile; the wasm and the prebuilt libraries as base64 in script elements,
// which a browser keeps as text.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { deflateRawSync } from "node:zlib";
import { defineConfig } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

function data(folder) {
  const element = (id, bytes) => `<script type="application/octet-stream;base64" id="${id}">${bytes.toString("base64")}</script>`;
  const read = (name) => readFileSync(join(folder, name));
  const libraries = readdirSync(folder).filter((name) => /\.(json|br)$/.test(name)).sort();
  return [
    element("wasm", deflateRawSync(read("brinell_web.wasm"), { level: 9 })),
    ...libraries.map((name) => element(`library:${name}`, read(name))),
  ].join("\n");
}

const folder = process.env.BRINELL_PAGE_DATA;
if (!folder) throw new Error("BRINELL_PAGE_DATA must name the folder with brinell_web.wasm and the libraries");

export default defineConfig({
  plugins: [
    viteSingleFile({ removeViteModuleLoader: true }),
    { name: "data", enforce: "post", transformIndexHtml: { order: "post", handler: (html) => html.replace("<!-- data -->", () => data(folder)) } },
  ],
  build: { target: "es2022", modulePreload: false },
});
