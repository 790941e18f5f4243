// The scene's text: colours, completion and help from the schema, the exporter's mistakes underlined. Its history is the page's undo.
import { autocompletion, type Completion, type CompletionContext, type CompletionResult, completionKeymap, startCompletion } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, isolateHistory, redo, redoDepth, undo, undoDepth } from "@codemirror/commands";
import { HighlightStyle, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { toml } from "@codemirror/legacy-modes/mode/toml";
import { type Diagnostic, setDiagnostics } from "@codemirror/lint";
import { Annotation, EditorState, Transaction } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, hoverTooltip, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import type { About, Json, Mistake, Path } from "./contract";
import { h } from "./dom";
import { type Place, placeAt, places } from "./places";
import type { Scene } from "./scene";
import { help, type Schema } from "./schema";

/** The drag to which a change belongs. */
const Gesture = Annotation.define<symbol>();
/** Changes closer to each other are one step of undo [ms]. */
const TOGETHER = 500;
/** Longer than any drag, and shorter than the time since 1970, which stands for that since a step of undo that is closed [ms]. */
const LONGEST = 1e9;

const colours = HighlightStyle.define([
  { tag: tags.comment, color: "var(--muted)", fontStyle: "italic" },
  { tag: tags.string, color: "var(--string)" },
  { tag: [tags.number, tags.bool, tags.atom], color: "var(--number)" },
  { tag: [tags.propertyName, tags.definition(tags.propertyName)], color: "var(--key)" },
]);

/** What a key's value may be: by the schema, and materials with their sources. */
function valuesOf(path: Path, schema: Schema, about: About): Completion[] {
  const quoted = (value: Json, detail?: string): Completion => ({ label: JSON.stringify(value), detail, type: "enum" });
  const keys = path.filter((step) => typeof step === "string");
  const name = keys.at(-1);
  if (name === "material") return about.materials.map((material) => quoted(material.name, material.source ?? undefined));
  const info = schema.info(name === "outputs" ? [...path, 0] : path);
  if (!info) return [];
  if (info.types.has("boolean")) return [quoted(true), quoted(false)];
  return [...info.choices.map(({ value, description }) => quoted(value, description)), ...info.examples.map((value) => quoted(value))];
}

function complete(context: CompletionContext, schema: Schema, about: About): CompletionResult | null {
  const text = context.state.doc.toString();
  const found = places(text);
  const line = context.state.doc.lineAt(context.pos);
  const before = text.slice(line.from, context.pos);
  const header = /^\s*\[\[?([\w.]*)$/.exec(before);
  if (header) {
    const tables = (schema.info([])?.keys ?? []).filter((name) => {
      const types = schema.info([name])?.types;
      return before.includes("[[") ? types?.has("array") : types?.has("object");
    });
    return { from: context.pos - (header[1] ?? "").length,
      options: tables.map((name) => ({ label: name, type: "class", info: schema.info([name])?.description })) };
  }
  if (/#/.test(before.replace(/"[^"]*"|'[^']*'/g, ""))) return null;
  const inside = placeAt(found, context.pos);
  const place = inside?.kind === "element" ? (found.find((one) => one.path.join() === inside.path.slice(0, -1).join()) ?? inside) : inside;
  if (place?.kind === "value" && context.pos > place.key && text[text.indexOf("=",
    place.key) + 1] !== undefined && !/=\s*\{/.test(text.slice(place.key, context.pos))) {
    const partial = context.matchBefore(/"[^"\n]*|\w*/);
    if (!partial || (!context.explicit && partial.from === partial.to && !/[=[,]\s*$/.test(before))) return null;
    const close = text[context.pos] === '"' && partial.text.startsWith('"') ? context.pos + 1 : undefined;
    return { from: partial.from, to: close, options: valuesOf(place.path, schema, about), validFor: /^"?[^"\n]*$/ };
  }
  const table = containing(found, context.pos, place);
  const name = context.matchBefore(/\w*/);
  if (!name || (!context.explicit && (name.from === name.to || !/(^|[{,])\s*\w*$/.test(before)))) return null;
  const info = schema.info(table);
  const present = new Set(found.filter(({ path, from }) =>
    path.length === table.length + 1 && path.join().startsWith(table.join()) && from !== name.from).map(({ path }) => path.at(-1)));
  return {
    from: name.from,
    options: (info?.keys ?? [])
      .filter((option) => !present.has(option))
      .map((option) => {
        const described = schema.info([...table, option]);
        return { label: option, type: "property", apply: (view: EditorView, _: Completion, from: number, to: number) => {
            const insert = `${option} = `;
            view.dispatch({ changes: { from, to, insert }, selection: { anchor: from + insert.length }, userEvent: "input.complete" });
            startCompletion(view);
          }, detail: described?.unit ?? undefined, info: described ? help(described) : undefined };
      }),
    validFor: /^\w*$/,
  };
}

function containing(found: Place[], offset: number, place: Place | null): Path {
  if (place?.kind === "value") return place.path;
  if (place?.kind === "bare") return place.path.slice(0, -1);
  return found.findLast(({ kind, from, key }) => kind === "header" && from <= offset && key <= offset)?.path ?? [];
}

export class Editor {
  readonly view: EditorView;
  #last: { time: number; gesture: symbol | undefined } = { time: 0, gesture: undefined };

  constructor(parent: HTMLElement, readonly scene: Scene, schema: Schema, about: About, text: string) {
    const hover = hoverTooltip((_view, position) => {
      const place = placeAt(scene.places, position);
      const info = place && position <= place.key ? schema.info(place.path) : null;
      const written = place ? scene.written(...place.path) : undefined;
      const says = info ? help(info, written?.unit, written?.size) : "";
      if (!place || !says) return null;
      return { pos: place.from, end: place.key, above: true, create: () => ({ dom: h("div", { class: "hover" }, says) }) };
    });
    this.view = new EditorView({
      parent,
      state: EditorState.create({
        doc: text,
        extensions: [
          lineNumbers(), history({ newGroupDelay: LONGEST, joinToEvent: (change, adjacent) => this.#joins(change, adjacent) }), drawSelection(), highlightActiveLine(), EditorView.lineWrapping,
          StreamLanguage.define(toml), syntaxHighlighting(colours), hover,
          autocompletion({ override: [(context) => complete(context, schema, about)], icons: false }),
          keymap.of([...completionKeymap, ...defaultKeymap, ...historyKeymap]),
          EditorView.contentAttributes.of({ "aria-label": "The scene as TOML", "data-test": "editor", spellcheck: "false", tabindex: "0" }),
          EditorView.updateListener.of((update) => {
            if (!update.docChanged) return;
            const last = update.transactions.findLast(({ docChanged }) => docChanged)!;
            this.#last = { time: last.annotation(Transaction.time) ?? 0, gesture: last.annotation(Gesture) };
            scene.read(update.state.doc.toString());
          }),
        ],
      }),
    });
    scene.write = (next, gesture) => this.write(next, gesture);
    scene.onCheck(() => this.#underline());
    scene.read(text);
  }

  /** Whether a change belongs to the last step of undo: all of a drag, however long it takes, and what is typed in one go. */
  #joins(change: Transaction, adjacent: boolean): boolean {
    const gesture = change.annotation(Gesture);
    if (gesture && gesture === this.#last.gesture) return true;
    return adjacent && (change.annotation(Transaction.time) ?? 0) - this.#last.time < TOGETHER;
  }

  /** Replaces what differs, so that cursor and comments stay where they are. */
  write(next: string, gesture: symbol | null): void {
    const now = this.view.state.doc.toString();
    let from = 0;
    while (from < now.length && now[from] === next[from]) from++;
    let tail = 0;
    while (tail < now.length - from && tail < next.length - from && now[now.length - 1 - tail] === next[next.length - 1 - tail]) tail++;
    this.view.dispatch({
      changes: { from, to: now.length - tail, insert: next.slice(from, next.length - tail) },
      userEvent: "input.type.form",
      annotations: gesture ? Gesture.of(gesture) : undefined,
    });
  }

  /** Another scene: one step of undo. */
  open(text: string): void {
    this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text }, selection: { anchor: 0 }, scrollIntoView: true,
      annotations: isolateHistory.of("full") });
  }

  show({ from, to }: Mistake): void {
    this.view.dispatch({ selection: { anchor: from, head: Math.min(to, this.view.state.doc.length) },
      effects: EditorView.scrollIntoView(from, { y: "center" }) });
    this.view.focus();
  }

  undo = (): boolean => undo(this.view);
  redo = (): boolean => redo(this.view);
  get depth(): { undo: number; redo: number } {
    return { undo: undoDepth(this.view.state), redo: redoDepth(this.view.state) };
  }

  #underline(): void {
    const length = this.view.state.doc.length;
    if (this.scene.text.length !== length) return;
    const diagnostic = (severity: Diagnostic["severity"]) => ({ from, to, message }: Mistake): Diagnostic => ({
      from: Math.min(from, Math.max(0, length - 1)),
      to: Math.min(Math.max(to, from + 1), length),
      severity,
      message,
    });
    const { mistakes, warnings } = this.scene.check;
    this.view.dispatch(setDiagnostics(this.view.state, [...mistakes.map(diagnostic("error")), ...warnings.map(diagnostic("warning"))]));
  }
}
