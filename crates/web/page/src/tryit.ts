// The FMU in the hands of an importer: choose its step and how it couples, and see what the ball does.
import type { Bounce, Way } from "./contract";
import { describe, h } from "./dom";
import { Engine } from "./engine";
import type { Results } from "./results";
import type { Scene } from "./scene";
import { digits, format } from "./units";

interface Run {
  way: Way;
  colour: number;
  bounce: Bounce;
}

const css = (name: string): string => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const GRAVITY = 9.81;

export class TryIt {
  readonly element: HTMLElement;
  readonly #canvas = h("canvas", { "data-test": "try.canvas", role: "img", "aria-label": "height of the ball over time" });
  readonly #boxes: { way: Way; box: HTMLInputElement }[] = [];
  readonly #ways = h("fieldset", { class: "ways" }, h("legend", {}, "How it is coupled"));
  readonly #step = h("input", { type: "range", min: -3, max: 3, step: 0.05, value: -1.5, "data-test": "try.step", "aria-label": "step of the importer", oninput: () => this.#plan() });
  readonly #stepText = h("output", { "data-test": "try.step.value" });
  readonly #table = h("div", { class: "table", "data-test": "try.table" });
  readonly #messages = h("ul", { class: "warnings", "data-test": "try.messages" });
  readonly #state = h("p", { class: "note", role: "status", "data-test": "try.state" });
  #runs: Run[] = [];
  #frame = 0;
  #timer = 0;
  #asked = 0;
  #text = "";

  constructor(readonly scene: Scene, readonly results: Results, readonly module: WebAssembly.Module) {
    this.element = h("div", { class: "tryit" },
      h("p", { class: "note" }, "Here the FMU itself runs, step by step, as in your simulator. A step too long, or a force that comes late, changes the rebound."),
      h("div", { class: "row asked" }, h("label", { class: "knob" }, h("span", { class: "knob-label" }, "Step of the importer", this.#stepText), this.#step),
        h("button", { type: "button", class: "primary", "data-test": "try.run", onclick: () => void this.run() }, "Let it bounce")),
      this.#ways, this.#state, this.#canvas, this.#table, this.#messages);
    new ResizeObserver(() => this.#draw(Infinity)).observe(this.#canvas);
    scene.onCheck(() => this.#plan());
  }

  /** Called when the page shows this part. */
  async shown(): Promise<void> {
    this.#plan();
  }

  get #visible(): boolean {
    return this.element.offsetParent !== null;
  }

  get #duration(): number {
    const law = this.results.prediction?.laws[0];
    return law ? law.loading_time + law.unloading_time : 1e-5;
  }

  /** The step in seconds: the slider counts it in contact times. */
  get #seconds(): number {
    return Number((10 ** Number(this.#step.value) * this.#duration).toPrecision(2));
  }

  #plan(): void {
    const parts = this.#duration / this.#seconds;
    this.#stepText.textContent = `${format(this.#seconds, "s", 2)}: ${parts >= 1 ? `${digits(parts, 2)} steps per contact` : `${digits(1 / parts, 2)} contacts in a step`}`;
    clearTimeout(this.#timer);
    if (this.#visible && this.scene.right) this.#timer = window.setTimeout(() => void this.run(), 150);
  }

  async #list(): Promise<void> {
    if (this.#boxes.length && this.#text === this.scene.text) return;
    this.#text = this.scene.text;
    const { ok } = await this.scene.engine.ask("ways", { text: this.scene.text });
    const before = new Map(this.#boxes.map(({ way, box }) => [way.name, box.checked]));
    const ways = ok ?? [];
    if (ways.length === before.size && ways.every(({ name }) => before.has(name))) return;
    this.#boxes.splice(0, Infinity, ...ways.map((way, index) => ({ way, box: h("input", { type: "checkbox", checked: before.get(way.name) ?? index < 3, "data-test": `way.${way.name}`, onchange: () => this.#plan() }) })));
    this.#ways.replaceChildren(this.#ways.firstElementChild!, ...this.#boxes.map(({ way, box }, index) =>
      h("label", { class: "law" }, box, h("span", {}, h("b", {}, h("i", { style: `--c: var(--series-${index % 6})` }), way.name), h("small", {}, `${way.what}${way.scene_lines.length ? ` Scene: ${way.scene_lines.join("; ")}` : ""}`)))));
  }

  async run(): Promise<void> {
    const asked = ++this.#asked;
    const prediction = this.results.prediction;
    if (!prediction) return;
    const height = prediction.speed ** 2 / (2 * GRAVITY);
    const law = prediction.laws[0];
    const time = Math.sqrt((2 * height) / GRAVITY) * (1 + 2 * (law?.restitution ?? 1) * 3);
    const { text } = this.scene;
    const step = this.#seconds;
    this.#state.textContent = "Computing …";
    try {
      await this.#list();
      const runs: Run[] = [];
      for (const [colour, { way, box }] of this.#boxes.entries()) {
        if (!box.checked) continue;
        const engine = new Engine(this.module); // a bounce needs an instance of its own
        try {
          const { ok } = await engine.ask("bounce", { text, way: way.name, step, height, time, gravity: GRAVITY });
          runs.push({ way, colour, bounce: ok });
        } finally {
          engine.end();
        }
        if (asked !== this.#asked) return;
      }
      this.#state.textContent = "";
      this.#runs = runs;
      this.#tell();
      this.#play();
    } catch (error) {
      if (asked === this.#asked) this.#state.textContent = describe(error);
    }
  }

  #tell(): void {
    const rows = this.#runs.flatMap(({ way, colour, bounce }) => bounce.rebounds.slice(0, 4).map((rebound, index) => {
      const off = rebound.restitution / rebound.exact - 1;
      return h("tr", { class: Math.abs(off) > 0.01 ? "bad" : "" },
        h("th", { scope: "row" }, index ? "" : h("i", { style: `--c: var(--series-${colour % 6})` }), index ? "" : way.name),
        ...[String(index + 1), format(rebound.time, "s"), format(rebound.speed_in, "m/s"), format(rebound.speed_out, "m/s"), digits(rebound.restitution), digits(rebound.exact), Math.abs(off) < 5e-7 ? "0" : `${digits(100 * off, 2)} %`].map((cell) => h("td", {}, cell)));
    }));
    this.#table.replaceChildren(h("table", {}, h("thead", {}, h("tr", {}, ...["way", "rebound", "at", "in", "out", "restitution", "exact", "off by"].map((title) => h("th", { scope: "col" }, title)))), h("tbody", {}, ...rows)));
    this.#messages.replaceChildren(...this.#runs.flatMap(({ way, bounce }) => bounce.messages.map((message) => h("li", {}, `${way.name}: ${message}`))));
  }

  #play(): void {
    cancelAnimationFrame(this.#frame);
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) return this.#draw(Infinity);
    const end = Math.max(...this.#runs.map(({ bounce }) => bounce.time.at(-1) ?? 0));
    const began = performance.now();
    const tick = (now: number): void => {
      const part = (now - began) / 5000;
      this.#draw(part < 1 ? part * end : Infinity);
      if (part < 1) this.#frame = requestAnimationFrame(tick);
    };
    this.#frame = requestAnimationFrame(tick);
  }

  /** The balls at `now`, and where they have been: their heights over time. */
  #draw(now: number): void {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    const pen = this.#canvas.getContext("2d");
    if (!pen || !width || !height) return;
    const scale = devicePixelRatio;
    if (this.#canvas.width !== Math.round(width * scale)) Object.assign(this.#canvas, { width: Math.round(width * scale), height: Math.round(height * scale) });
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    pen.clearRect(0, 0, width, height);
    const tracks = this.#runs.flatMap((run) => run.bounce.heights.map((heights) => ({ ...run, heights })));
    const end = Math.max(...this.#runs.map(({ bounce }) => bounce.time.at(-1) ?? 0), 1e-9);
    const top = Math.max(...tracks.map(({ heights }) => heights[0] ?? 0), 1e-9) * 1.15;
    const [radius, floor] = [9, height - 26];
    const stage = 28 * Math.max(1, tracks.length) + 16;
    const x = (time: number): number => stage + 10 + ((width - stage - 24) * time) / end;
    const y = (metres: number): number => floor - radius - ((floor - 2 * radius - 6) * metres) / top;
    pen.fillStyle = css("--line");
    pen.fillRect(0, floor, width, 6);
    pen.fillStyle = css("--muted");
    pen.font = "11px system-ui";
    pen.fillText("0", x(0), height - 4);
    pen.textAlign = "right";
    pen.fillText(format(end, "s", 3), width - 10, height - 4);
    pen.textAlign = "left";
    tracks.forEach(({ bounce, heights, colour }, track) => {
      pen.strokeStyle = pen.fillStyle = css(`--series-${colour % 6}`);
      pen.lineWidth = 1.5;
      pen.beginPath();
      let last = 0;
      for (; last < bounce.time.length && bounce.time[last]! <= now; last++) pen.lineTo(x(bounce.time[last]!), Math.max(-50, y(heights[last]!)));
      pen.stroke();
      const at = Math.max(0, Math.min(last, heights.length) - 1);
      pen.beginPath();
      pen.arc(16 + 28 * track + radius, Math.max(radius, y(heights[at] ?? 0)), radius, 0, 2 * Math.PI);
      pen.fill();
    });
  }
}
