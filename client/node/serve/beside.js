// Live music, without waiting for it.

/**
 * Yields lists: of one piece as soon as `source`, an iterable, gives it; and beside it, each `every` milliseconds, empty ones. Ends when it ends.
 * When this is closed it closes the source, even while that is silent.
 */
export async function* beside(source, every) {
  const pieces = source[Symbol.asyncIterator]?.() ?? source[Symbol.iterator]();
  let [come, isDue, isOver, timer] = [undefined, false, false, undefined];
  let wake = () => {};
  const next = async () => {
    try {
      return await pieces.next();
    } catch (error) {
      isOver = true;
      throw error;
    }
  };
  const take = (taken) => {
    come = taken;
    wake();
  };
  const ask = () => {
    come = undefined;
    const answer = next().then(async ({ done, value }) => {
      isOver = Boolean(done);
      return { done, piece: await value };
    });
    answer.then(take, (error) => take({ failed: true, error }));
  };
  const tick = () => {
    isDue = false;
    timer = setTimeout(() => {
      isDue = true;
      wake();
    }, every);
  };
  try {
    for (tick(), ask(); ; ) {
      // Not a race, each of which would leave something behind on a silent source.
      if (!isDue && !come) await new Promise((resolve) => (wake = resolve));
      if (isDue) {
        tick();
        yield [];
        continue;
      }
      const { done, piece, failed, error } = come;
      if (failed) throw error;
      if (done) return;
      ask();
      yield [piece];
    }
  } finally {
    clearTimeout(timer);
    if (!isOver) close(pieces).catch(() => {}); // once it has given the piece that it is about
  }
}

/** Also what is thrown at once is a rejection. */
const close = async (pieces) => pieces.return?.();
