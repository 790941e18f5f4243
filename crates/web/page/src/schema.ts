// What the JSON schema of scenes says about a key: for labels, help, ranges, completion.
import type { Json, Path, Table } from "./contract";
import { pretty } from "./units";

export interface Choice {
  value: Json;
  description: string;
}

export interface KeyInfo {
  name: string;
  label: string;
  description: string;
  unit: string | null;
  /** Units in which it is usually given. */
  units: string[];
  /** What it may be, in a unit of this size. */
  range(unit: string, size: number): string;
  default: Json | undefined;
  /** What an absent key means, in words. */
  absent: string;
  examples: Json[];
  choices: Choice[];
  types: Set<string>;
  keys: string[];
  required: Set<string>;
}

const isTable = (json: Json | undefined): json is Table => typeof json === "object" && json !== null && !Array.isArray(json);
const text = (json: Json | undefined): string => (typeof json === "string" ? json : "");
const list = (json: Json | undefined): Json[] => (Array.isArray(json) ? json : []);
/** What the schema says of one of the values of an `enum`. */
function said(part: Table, index: number): string {
  const docs = isTable(part["x-taplo"]) ? part["x-taplo"].docs : undefined;
  return isTable(docs) ? text(list(docs.enumValues)[index]) : "";
}

export const words = (key: string): string =>
  (key.charAt(0).toUpperCase() + key.slice(1).replaceAll("_", " ")).replace("Youngs", "Young's").replace("Poissons", "Poisson's");

export class Schema {
  constructor(readonly root: Table) {}

  /** A schema and all that it refers to or chooses from. */
  #parts(node: Json | undefined): Table[] {
    if (!isTable(node)) return [];
    const reference = text(node.$ref);
    const target = reference && reference.slice(2).split("/").reduce<Json | undefined>((at, step) => (isTable(at) ? at[step] : undefined), this.root);
    const inner = [...list(node.allOf), ...list(node.anyOf), ...list(node.oneOf), ...(node.else ? [node.else] : [])].flatMap((part) => this.#parts(part));
    return [node, ...(target ? this.#parts(target) : []), ...inner];
  }

  #step(node: Json | undefined, step: string | number): Table | undefined {
    for (const part of this.#parts(node)) {
      const next = typeof step === "number" ? part.items : isTable(part.properties) ? part.properties[step] : undefined;
      if (isTable(next)) return next;
    }
    return undefined;
  }

  info(path: Path): KeyInfo | null {
    const node = path.reduce<Table | undefined>((at, step) => this.#step(at, step), this.root);
    if (!node) return null;
    const parts = this.#parts(node);
    const first = (name: string): Json | undefined => parts.find((part) => part[name] !== undefined)?.[name];
    const name = String(path.at(-1) ?? "");
    const unit = text(first("x-unit"));
    return {
      name,
      label: words(name),
      description: text(first("description")),
      unit: unit && unit !== "1" ? unit : null,
      units: list(first("x-units")).map(text),
      range: (own, size) => range(["minimum", "exclusiveMinimum", "maximum", "exclusiveMaximum"].map((name) =>
        ((end) => (typeof end === "number" ? end / size : null))(first(name))), own),
      default: first("default"),
      absent: text(first("x-default")).replaceAll("`", ""),
      examples: list(first("examples")),
      choices: parts.flatMap((part) => [
        ...list(part.enum).map((value, index) => ({ value, description: said(part, index) })),
        ...(part.const === undefined ? [] : [{ value: part.const, description: text(part.description) }]),
      ]),
      types: new Set(parts.flatMap((part) => (Array.isArray(part.type) ? part.type.map(text) : text(part.type) ? [text(part.type)] : []))),
      keys: [...new Set(parts.flatMap((part) => (isTable(part.properties) ? Object.keys(part.properties) : [])))],
      required: new Set(parts.flatMap((part) => list(part.required).map(text))),
    };
  }
}

function range([least, above, most, below]: (number | null | undefined)[], unit: string): string {
  const short = (value: number): string => {
    const rounded = Number(value.toPrecision(4));
    return rounded !== 0 && (Math.abs(rounded) >= 1e5 || Math.abs(rounded) < 1e-4) ? rounded.toExponential().replace("+", "") : String(rounded);
  };
  const given = (end: number | null | undefined): end is number => typeof end === "number";
  const ends = [
    given(above) ? `more than ${short(above)}` : given(least) ? `from ${short(least)}` : "",
    given(below) ? `less than ${short(below)}` : given(most) ? `to ${short(most)}` : "",
  ].filter(Boolean);
  return ends.length ? `${ends.join(" ")}${unit && unit !== "1" ? " " + pretty(unit) : ""}` : "";
}

/** What a key is, in one line: its description, its range in the unit that is chosen, and what its absence means. */
export function help(info: KeyInfo, unit = info.unit ?? "", size = 1): string {
  const standard = info.default === undefined || info.default === null ? "" : `Default: ${JSON.stringify(info.default)}.`;
  const absent = info.absent === "required" ? "Required." : info.absent && `Without: ${info.absent}.`;
  const range = info.range(unit, size);
  return [info.description.replace(/\s+/g, " "), range && `Range: ${range}.`, absent || standard].filter(Boolean).join(" ");
}
