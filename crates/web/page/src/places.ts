// Where the keys of a scene stand in its text, also while it is being typed and is no TOML yet.
import type { Path } from "./contract";

export interface Place {
  path: Path;
  /** The key, or the header of a table. */
  from: number;
  key: number;
  /** The end of its value; that of a table is the next header. */
  to: number;
  kind: "header" | "value" | "bare" | "element";
}

const NAME = /[A-Za-z0-9_-]+|"(?:[^"\\\n]|\\.)*"|'[^'\n]*'/y;
const GAP = /(?:[ \t\r\n]+|#[^\n]*)*/y;
const BLANK = /[ \t]*/y;
const STRING = /"""[^]*?(?:"""|$)|'''[^]*?(?:'''|$)|"(?:[^"\\\n]|\\.)*"?|'[^'\n]*'?/y;
const BARE = /[^,\]}#\n]*/y;

export function places(text: string): Place[] {
  const found: Place[] = [];
  const counts = new Map<string, number>();
  let at = 0;
  let table: Path = [];

  const take = (pattern: RegExp): string => {
    pattern.lastIndex = at;
    const match = pattern.exec(text)?.[0] ?? "";
    at += match.length;
    return match;
  };
  const key = (): string[] => {
    const names: string[] = [];
    for (let name = take(NAME); name; name = text[at] === "." ? (at++, take(BLANK), take(NAME)) : "") {
      names.push(name.replace(/^(["'])(.*)\1$/, "$2"));
      take(BLANK);
    }
    return names;
  };
  const value = (path: Path): void => {
    take(BLANK);
    if (text[at] === "[") {
      at++;
      for (let index = 0; take(GAP), at < text.length && text[at] !== "]"; index++) {
        const from = at;
        value([...path, index]);
        found.push({ path: [...path, index], from, key: from, to: at, kind: "element" });
        take(GAP);
        if (text[at] === ",") at++;
        else if (at === from) at++;
      }
      at++;
    } else if (text[at] === "{") {
      at++;
      while (take(GAP), at < text.length && text[at] !== "}") {
        const before = at;
        pair(path);
        take(GAP);
        if (text[at] === "," || at === before) at++;
      }
      at++;
    } else if (!take(STRING)) take(BARE);
    at = Math.min(at, text.length);
  };
  const pair = (parent: Path): void => {
    const from = at;
    const path = [...parent, ...key()];
    const end = at;
    if (path.length === parent.length) return;
    if (text[at] !== "=") {
      found.push({ path, from, key: end, to: end, kind: "bare" });
      return;
    }
    at++;
    value(path);
    found.push({ path, from, key: from + text.slice(from, end).trimEnd().length, to: at, kind: "value" });
  };
  /** A header's path, with the last element of each array of tables on its way. */
  const header = (names: string[], array: boolean): Path => {
    const path: (string | number)[] = [];
    names.forEach((name, index) => {
      path.push(name);
      const list = JSON.stringify(path);
      if (array && index === names.length - 1) counts.set(list, (counts.get(list) ?? -1) + 1);
      const count = counts.get(list);
      if (count !== undefined) path.push(count);
    });
    return path;
  };

  while (take(GAP), at < text.length) {
    const from = at;
    if (text[at] === "[") {
      const array = text[at + 1] === "[";
      at += array ? 2 : 1;
      take(BLANK);
      table = header(key(), array);
      at = from + /[^\n#]*/.exec(text.slice(from))![0].trimEnd().length;
      const last = found.findLast(({ kind }) => kind === "header");
      if (last) last.to = from;
      found.push({ path: table, from, key: at, to: text.length, kind: "header" });
    } else {
      pair(table);
      if (at === from || text[at] !== "\n") take(/[^\n]*/y);
    }
  }
  return found;
}

/** The innermost key or table at an offset. */
export function placeAt(found: Place[], offset: number): Place | null {
  return found
    .filter((place) => place.from <= offset && offset <= place.to)
    .reduce<Place | null>((best, place) => (best && best.to - best.from <= place.to - place.from ? best : place), null);
}
