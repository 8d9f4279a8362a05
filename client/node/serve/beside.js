// Live music, without waiting for it.

/**
 * Yields lists: of one piece as soon as `source`, an iterable, gives it; and beside it, each `every` milliseconds, empty ones. Ends when it ends.
 * When this is closed it closes the source, even while that is silent.
 */
export async function* beside(source, every) {
  const pieces = source[Symbol.asyncIterator]?.() ?? source[Symbol.iterator]();
  const ask = () => Promise.resolve(pieces.next()).then(async ({ done, value }) => ({ done, piece: await value }));
  let timer;
  const tick = () => new Promise((resolve) => (timer = setTimeout(resolve, every)));
  try {
    for (let [next, beat] = [ask(), tick()]; ; ) {
      const come = await Promise.race([beat, next]);
      if (come?.done) return;
      if (come) next = ask();
      else beat = tick();
      next.catch(() => {}); // it is thrown above, if it is awaited
      yield come ? [come.piece] : [];
    }
  } finally {
    clearTimeout(timer);
    Promise.resolve(pieces.return?.()).catch(() => {}); // once it has given the piece that it is about
  }
}
