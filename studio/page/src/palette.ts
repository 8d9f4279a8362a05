/// A colour of the page as style.css has it now, in light or dark.
export function colour(name: 'accent' | 'gold' | 'left' | 'paper' | 'right' | 'wave' | 'wave-done' | ReturnType<typeof shirtOf>) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/// The colour that the dancer of a take wears: 0 is the dance as it is.
export const shirtOf = (take: number) => `take-${Math.min(take, 3)}` as const;
