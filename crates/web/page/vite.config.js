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

/** The licenses of the packages whose code is in the page, after those of the crates in its module. */
function licenses(bundle, crates) {
  const modules = Object.values(bundle).flatMap((chunk) => Object.keys(chunk.modules ?? {}));
  const found = modules.map((path) => /^.*\/node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(path)).filter(Boolean);
  const folders = new Map(found.map(([folder, name]) => [name, folder]));
  const text = [...folders].sort().map(([name, folder]) => {
    const file = readdirSync(folder).find((one) => /^licen[cs]e/i.test(one));
    if (!file) throw new Error(`${name} has no license`);
    return `${name}\n\n${readFileSync(join(folder, file), "utf8").trim()}`;
  });
  return `<script type="text/plain" id="licenses">${[crates, ...text].join("\n\n\n").replaceAll("</", "<\\/")}</script>`;
}

const folder = process.env.BRINELL_PAGE_DATA;
if (!folder) throw new Error("BRINELL_PAGE_DATA must name the folder with brinell_web.wasm and the libraries");

export default defineConfig({
  plugins: [
    viteSingleFile({ removeViteModuleLoader: true }),
    {
      name: "data",
      enforce: "post",
      transformIndexHtml: { order: "post", handler: (html, { bundle }) => html.replace("<!-- data -->", () => `${licenses(bundle, readFileSync(join(folder, "licenses.txt"), "utf8").trim())}\n${data(folder)}`) },
    },
  ],
  build: { target: "es2022", modulePreload: false },
});
