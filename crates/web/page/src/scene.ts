// The scene: one text, which form and editor both show. Edits of the form go through the exporter, which keeps comments.
import type { Check, Edit, Json, Path, Table } from "./contract";
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
  check: Check = { values: {}, mistakes: [], doubts: [], files: [] };
  /** The last values of a text that was TOML. */
  values: Table = {};
  places: Place[] = [];
  /** Writes into the editor, which then calls `read`. */
  write: (text: string) => void = () => {};
  readonly #checked: (() => void)[] = [];
  readonly #edits = new Map<string, Edit>();
  #editing = false;
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

  read(text: string): void {
    this.text = text;
    void this.#look();
  }

  /** Sets keys (null removes one); the newest value of each. */
  edit(...edits: Edit[]): void {
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
      try {
        const { ok } = await this.engine.ask("edit", { text: before, edits }, undefined, true);
        if (this.text !== before) continue; // typed meanwhile: once more, on the new text
        for (const edit of edits) if (this.#edits.get(key(edit.path)) === edit) this.#edits.delete(key(edit.path));
        if (ok.text !== before) this.write(ok.text);
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
    this.values = check.values ?? this.values;
    this.places = places(text);
    this.#looked = text;
    this.#tell();
  }

  #tell(): void {
    for (const listener of this.#checked) listener();
  }
}
