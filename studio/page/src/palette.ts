/// A colour of the page as style.css has it now, in light or dark.
export function colour(name: 'accent' | 'gold' | 'left' | 'paper' | 'right' | 'wave' | 'wave-done') {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
