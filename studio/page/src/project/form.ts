// A song's sections, with the same letter for similar ones, as musicians write them.
type Passage = { from: number; to: number; like: number };
/// `nth`: its index among sections of the same letter. `others`: the seconds of these.
export type Section = { from: number; to: number; nth: number; letter: string; others: number[] };

type Piece = { from: number; to: number; like: number };
const least = 1; // seconds of the shortest section

/// The first occurrence of the music of [from, to), piece by piece.
function firstOf(from: number, to: number, known: Piece[]): [number, number][] {
  if (to - from < 1e-6) return [];
  const piece = known.find((some) => some.from < to - 1e-6 && some.to > from + 1e-6);
  if (!piece) return [[from, to]];
  const [begin, end] = [Math.max(from, piece.from), Math.min(to, piece.to)];
  const like = piece.like + begin - piece.from;
  return [...firstOf(from, begin, known), [like, like + end - begin], ...firstOf(end, to, known)];
}

/// Sections of a song with these passages, in order; no two of them overlap.
export function sections(passages: Passage[]): Section[] {
  const pieces: Piece[] = [];
  for (const { from, to, like } of passages) {
    // A passage longer than its lag repeats its own beginning.
    for (let at = from; at < to - 1e-6; at += from - like) {
      let place = at;
      for (const [first, end] of firstOf(like, like + Math.min(from - like, to - at), pieces)) {
        const last = pieces.at(-1);
        if (last && place > at && Math.abs(last.like + last.to - last.from - first) < 1e-6) last.to += end - first;
        else pieces.push({ from: place, to: place + end - first, like: first });
        place += end - first;
      }
    }
  }
  // An original is one section as far as any repetition of it goes.
  const firsts: [number, number][] = [];
  const all = pieces.map(({ from, to, like }): [number, number] => [like, like + to - from]).sort((a, b) => a[0] - b[0]);
  for (const [from, to] of all) {
    const last = firsts.at(-1);
    if (last && from < last[1] - least) last[1] = Math.max(last[1], to);
    else firsts.push([last ? Math.max(from, last[1]) : from, to]);
  }
  const long = firsts.filter(([from, to]) => to - from >= least);
  const spans = long.map(([from, to], nth) => ({ from, to, nth }));
  const back: typeof spans = [];
  let likeTo = 0; // the first end of the last one
  for (const { from, to, like } of pieces) {
    const nth = long.findIndex(([begin, end]) => like + (to - from) / 2 >= begin && like + (to - from) / 2 < end);
    const last = back.at(-1);
    if (nth < 0) continue;
    if (last?.nth === nth && Math.abs(last.to - from) < 1e-6 && Math.abs(likeTo - like) < 1e-6) last.to = to;
    else back.push({ from, to, nth });
    likeTo = like + to - from;
  }
  const every = [...spans, ...back.filter(({ from, to }) => to - from >= least)].sort((a, b) => a.from - b.from);
  return every.map(({ from, to, nth }) => ({
    from, to, nth,
    letter: String.fromCharCode(65 + (nth % 26)),
    others: every.filter((other) => other.nth === nth && other.from !== from).map((other) => other.from),
  }));
}
