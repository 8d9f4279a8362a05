// How long something still takes, by what it took so far.

const least = 2; // seconds after which a guess is worth telling
const few = 5; // seconds

/// Seconds as people say them.
export function roughly(seconds: number): string {
  if (seconds < few) return 'a few seconds';
  if (seconds < 55) return `about ${Math.ceil(seconds / 5) * 5} s`;
  return `about ${Math.ceil(seconds / 60)} min`;
}

/// For people: what is left after so many seconds made a share, 0 to 1, of it; empty while nobody knows.
export const timeLeft = (share: number, took: number): string =>
  took < least || share <= 0 ? '' : roughly((took * (1 - share)) / share);
