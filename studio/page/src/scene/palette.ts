/// The current value of a colour of style.css, light or dark.
export function colour(name: 'accent' | 'gold' | 'left' | 'paper' | 'right' | 'wave' | 'wave-done' | ReturnType<typeof shirtOf>) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/// The shirt colour of a take's dancer; 0 is the present dance.
export const shirtOf = (take: number) => `take-${Math.min(take, 3)}` as const;
