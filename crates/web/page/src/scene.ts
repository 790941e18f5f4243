// The scene: one text, which form and editor both show. Edits of the form go through the exporter, which keeps comments.
import type { Check, Closed, Edit, Json, Path, Table, Typed, Written } from "./contract";
import { toast } from "./dom";
import type { Engine } from "./engine";
import { Refusal } from "./engine";
import { type Place, places } from "./places";

export const key = (path: Path): string => path.join(".");

export function valueAt(values: Json | undefined, path: Path): Json | undefined {
  return path.reduce<Json | undefined>(
    (value, step) => (value && typeof value === "object" ? (value as { [key: string | number]: Json })[step] : undefined),
    values,
  );
}

export class Scene {
  text = "";
  check: Check = { values: {}, quantities: {}, mistakes: [], warnings: [], files: [], closed: {} };
  /** The last values of a text that was TOML. */
  values: Table = {};
  #quantities: Check["quantities"] = {};
  places: Place[] = [];
  /** Writes into the editor, which then calls `read`. All of one gesture is one step of undo. */
  write: (text: string, gesture: symbol | null) => void = () => {};
  readonly #checked: (() => void)[] = [];
  readonly #edits = new Map<string, Edit>();
  #editing = false;
  #gesture: symbol | null = null;
  #looked = "";

  constructor(readonly engine: Engine) {}

  /** Calls `listener` whenever the exporter has looked at a new text. */
  onCheck(listener: () => void): void {
    this.#checked.push(listener);
  }

  get right(): boolean {
    return this.check.mistakes.length === 0;
  }

  /** Whether edits of the form aren't in the text yet. */
  get busy(): boolean {
    return this.#editing || this.#edits.size > 0;
  }

  value(...path: Path): Json | undefined {
    return valueAt(this.values, path);
  }

  /** Why the scene can't have this key, or this value of it, beside what it has; what it has may stay. */
  closed(path: Path, value?: Json): Closed | undefined {
    const now = this.value(...path);
    if (now !== undefined && (value === undefined || now === value || (Array.isArray(now) && now.includes(value)))) return undefined;
    if (value !== undefined) return this.check.closed[`${key(path)}=${String(value)}`];
    // a key is closed with the table that it would begin
    const tables = path.map((_, at) => path.slice(0, at + 1)).filter((part) => this.value(...part) === undefined);
    return tables.map((part) => this.check.closed[key(part)]).find(Boolean);
  }

  /** Number and unit of a key whose text has both. */
  written(...path: Path): Written | undefined {
    return this.#quantities[key(path)];
  }

  /** The SI number of a key, bare or with a unit. */
  si(...path: Path): number | null {
    const value = this.value(...path);
    return typeof value === "number" ? value : (this.written(...path)?.number ?? null);
  }

  read(text: string): void {
    this.text = text;
    void this.#look();
  }

  /** Sets keys (null removes one); the newest value of each. */
  edit(...edits: Edit[]): void {
    this.#gesture = null;
    this.#put(edits);
  }

  /** What is typed for a key, or dragged: `gesture` tells one drag from the next. */
  type(path: Path, typed: Typed, gesture: symbol | null = null): void {
    this.#gesture = gesture;
    this.#put([{ path, typed: { ...typed, bare: typeof this.value(...path) === "number" } }]);
  }

  #put(edits: Edit[]): void {
    for (const edit of edits) {
      this.#edits.delete(key(edit.path));
      this.#edits.set(key(edit.path), edit);
    }
    if (!this.#editing) void this.#apply();
  }

  async #apply(): Promise<void> {
    this.#editing = true;
    while (this.#edits.size > 0) {
      const edits = [...this.#edits.values()];
      const before = this.text;
      const gesture = this.#gesture;
      try {
        const { ok } = await this.engine.ask("edit", { text: before, edits }, undefined, true);
        if (this.text !== before) continue; // typed meanwhile: once more, on the new text
        for (const edit of edits) if (this.#edits.get(key(edit.path)) === edit) this.#edits.delete(key(edit.path));
        if (ok.text !== before) this.write(ok.text, gesture);
      } catch (error) {
        if (!(error instanceof Refusal)) throw error;
        this.#edits.clear();
        toast(error.message);
      }
    }
    this.#editing = false;
    if (this.#looked === this.text) this.#tell();
  }

  async #look(): Promise<void> {
    const text = this.text;
    const check = await this.engine.newest("check", "check", { text }, true);
    if (!check || text !== this.text) return;
    this.check = check;
    if (check.values) [this.values, this.#quantities] = [check.values, check.quantities];
    this.places = places(text);
    this.#looked = text;
    this.#tell();
  }

  #tell(): void {
    for (const listener of this.#checked) listener();
  }
}
