// Answers as lines of a chart, and the bands that uncertain strengths make of them.
import { type Band, type Line, valueAt } from "./charts";
import type { Columns, Families, SweepBands } from "./contract";

/** A curve that turns back, cut where it turns: loading lines, and thin ones for what lies inside. */
export function cycle(answer: Columns, from: number): Line[] {
  return answer.laws.flatMap((law, index) => {
    const [x, y] = [law.indentation as number[], law.force as number[]];
    const lines: Line[] = [];
    let start = 0;
    let deepest = -Infinity;
    for (let end = 1; end <= x.length; end++) {
      const turned = end === x.length || (end - start > 1 && Math.sign(x[end]! - x[end - 1]!) * Math.sign(x[start + 1]! - x[start]!) < 0);
      if (!turned) continue;
      const rises = x[end - 1]! > x[start]!;
      const piece = { x: x.slice(start, end), y: y.slice(start, end) };
      if (!rises) {
        piece.x.reverse();
        piece.y.reverse();
      }
      const last = end === x.length;
      if (rises) {
        const beyond = piece.x.findIndex((one) => one > deepest);
        if (deepest > 0) lines.push({ law: law.law, what: "again", colour: from + index, thin: true, dashed: true, x: piece.x.slice(0, beyond),
          y: piece.y.slice(0, beyond) });
        lines.push({ law: law.law, colour: from + index, x: piece.x.slice(Math.max(0, beyond - 1)), y: piece.y.slice(Math.max(0, beyond - 1)) });
        deepest = piece.x.at(-1) ?? deepest;
      } else lines.push({ law: law.law, what: "unloading", colour: from + index, dashed: true, thin: !last, ...piece });
      start = end - 1;
    }
    return joined(lines);
  });
}

/** The pieces of loading as one line. */
function joined(lines: Line[]): Line[] {
  const loading = lines.filter((line) => !line.thin && !line.dashed);
  const [first, ...more] = loading;
  if (!first) return lines;
  return [{ ...first, x: loading.flatMap(({ x }) => x), y: loading.flatMap(({ y }) => y) }, ...lines.filter((line) => !more.includes(line) && line !== first)];
}

export const plain = (answer: Columns, x: string, y: string, from: number, more: Partial<Line> = {}): Line[] =>
  answer.laws.map((law, index) => ({ law: law.law, colour: from + index, x: law[x] as number[], y: law[y] as number[], ...more }));

/** Points of a band. */
const POINTS = 160;

/** A band with an end to each side of each point, where they are known. */
function bandOf(line: Line, x: number[], ends: ([number, number] | undefined)[]): Band {
  const at = x.flatMap((_, index) => (ends[index] ? [index] : []));
  return { line, x: at.map((index) => x[index]!), low: at.map((index) => ends[index]![0]), high: at.map((index) => ends[index]![1]) };
}

/** The band around a line, whose force is nothing beyond its ends: each strength is independent of the others, and squares add up. */
function around(line: Line, families: Line[][]): Band {
  const all = [line, ...families.flat()];
  const first = Math.min(...all.map(({ x }) => x[0] ?? Infinity));
  const last = Math.max(...all.map(({ x }) => x.at(-1) ?? -Infinity));
  const x = Array.from({ length: POINTS + 1 }, (_, index) => first + ((last - first) * index) / POINTS);
  const ends = x.map((at): [number, number] => {
    const middle = valueAt(line, at) ?? 0;
    const squares = [0, 0];
    for (const family of families) {
      const values = [middle, ...family.map((one) => valueAt(one, at) ?? 0)];
      squares[0]! += (middle - Math.min(...values)) ** 2;
      squares[1]! += (Math.max(...values) - middle) ** 2;
    }
    return [Math.max(0, middle - Math.sqrt(squares[0]!)), middle + Math.sqrt(squares[1]!)];
  });
  return bandOf(line, x, ends);
}

/** The bands around those of the drawn lines that `kinds` choose; `lines` makes lines of a law. */
export function bandsOf(drawn: Line[], { families }: Families, lines: (answer: Columns) => Line[], kinds: ((line: Line) => boolean)[]): Band[] {
  if (families.length === 0) return [];
  return kinds.flatMap((kind) => {
    const line = drawn.find(kind);
    const all = families.map((family) => family.laws.map((law) => lines({ ...family, laws: [law] }).find(kind)).filter((one) => one !== undefined));
    return line ? [around(line, all)] : [];
  });
}

/** Those of quantities over the speed: their ratios to the lines are found at few speeds. */
export function bandsOverSpeed(lines: Line[], { speed, bands }: SweepBands): Band[] {
  const known = bands.flatMap((one, index) => (one ? [index] : []));
  if (known.length < 2) return [];
  return lines.filter(({ what }) => what).map((line) => {
    const logs = known.map((index) => Math.log(speed[index]!));
    const ratios = [0, 1].map((end) => known.map((index) => {
      const [middle, at] = [valueAt(line, speed[index]!), bands[index]![line.what!]![end]!];
      return middle ? at / middle : 1;
    }));
    const ends = line.x.map((x, index): [number, number] | undefined => {
      const [low, high] = ratios.map((y) => valueAt({ x: logs, y }, Math.log(x)));
      return low != null && high != null ? [line.y[index]! * low, line.y[index]! * high] : undefined;
    });
    return bandOf(line, line.x, ends);
  });
}
