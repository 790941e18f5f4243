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
  range: string;
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
    const inner = [...list(node.allOf), ...list(node.anyOf), ...list(node.oneOf)].flatMap((part) => this.#parts(part));
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
      range: range(first("minimum"), first("exclusiveMinimum"), first("maximum"), first("exclusiveMaximum"), unit),
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

function range(least: Json | undefined, above: Json | undefined, most: Json | undefined, below: Json | undefined, unit: string): string {
  const short = (value: number): string => (Math.abs(value) >= 1e5 ? value.toExponential().replace("+", "") : String(value));
  const ends = [
    typeof above === "number" ? `more than ${short(above)}` : typeof least === "number" ? `from ${short(least)}` : "",
    typeof below === "number" ? `less than ${short(below)}` : typeof most === "number" ? `to ${short(most)}` : "",
  ].filter(Boolean);
  return ends.length ? `${ends.join(" ")}${unit && unit !== "1" ? " " + pretty(unit) : ""}` : "";
}

/** What a key is, in one line: its description, its range, and what its absence means. */
export function help(info: KeyInfo): string {
  const standard = info.default === undefined || info.default === null ? "" : `Default: ${JSON.stringify(info.default)}.`;
  const absent = info.absent === "required" ? "Required." : info.absent && `Without: ${info.absent}.`;
  return [info.description.replace(/\s+/g, " "), info.range && `Range: ${info.range}.`, absent || standard].filter(Boolean).join(" ");
}
