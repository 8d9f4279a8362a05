// Callbacks of others. What they throw is their own fault: it ends no dance, and no process.

/** In browsers window.onerror hears of it, too. */
const report = (error) => (globalThis.reportError ?? console.error)(error);

/** A function that calls `callback`, if there is one, and reports what that throws, or rejects with, on the console. */
export const isolated = (callback) => (...news) => {
  try {
    callback?.(...news)?.then?.(undefined, report);
  } catch (error) {
    report(error);
  }
};
