// Estimates remaining time from elapsed time.

const least = 2; // seconds before the first estimate
const few = 5; // seconds

/// Seconds as rough text.
export function roughly(seconds: number): string {
  if (seconds < few) return 'a few seconds';
  if (seconds < 55) return `about ${Math.ceil(seconds / 5) * 5} s`;
  return `about ${Math.ceil(seconds / 60)} min`;
}

/// The remaining time as text, from the share done, 0 to 1, and the seconds it took; empty if unknown.
export const timeLeft = (share: number, took: number): string =>
  took < least || share <= 0 ? '' : roughly((took * (1 - share)) / share);
