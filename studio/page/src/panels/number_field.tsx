// A number field: typed, or changed by arrow keys; with Shift by ten steps. Invalid input shows a message and changes nothing.
import { useSignal } from '@preact/signals';
import { useId } from 'preact/hooks';

type Props = {
  /// The visible label, and one for screen readers if that says too little.
  label: string;
  name: string;
  value: number;
  low: number;
  high: number;
  step: number;
  /// The valid range: "The left elbow bends 0 to 160 degrees".
  rule: string;
  set: (value: number) => void;
  focused?: () => void;
};

export function NumberField({ label, name, value, low, high, step, rule, set, focused }: Props) {
  /// The message for invalid input, until the number changes.
  const hint = useSignal({ text: '', at: value });
  /// What is being typed, which no drawing of the panel may overwrite; what is wrong stays until the field is left.
  const typed = useSignal<string | null>(null);
  const slip = Math.abs(hint.value.at - value) < 1e-3 ? hint.value.text : '';
  const id = useId();
  const take = (text: string) => {
    const wanted = text.trim() === '' ? NaN : Number(text);
    const isFine = wanted >= low && wanted <= high;
    hint.value = { text: isFine ? '' : `${rule}${text.trim() === '' ? ': a number is missing' : `, not ${text}`}.`, at: value };
    if (!isFine) return;
    typed.value = null;
    if (wanted !== value) set(wanted);
  };
  const press = (event: KeyboardEvent) => {
    const way = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
    if (!way) return;
    event.preventDefault();
    typed.value = null;
    const wanted = Math.round((value + way * step * (event.shiftKey ? 10 : 1)) / step) * step;
    const most = Math.min(Math.max(wanted, low), high);
    hint.value = { text: most === wanted ? '' : `${rule}.`, at: most };
    if (most !== value) set(most);
  };
  return (
    <label class="number">
      <span aria-hidden="true">{label}</span>
      <input type="number" step="any" min={low} max={high} value={typed.value ?? Number(value.toFixed(step < 1 ? 2 : 1))} aria-label={name}
        aria-invalid={!!slip} aria-describedby={slip ? id : undefined}
        onKeyDown={press} onFocus={focused} onInput={(event) => (typed.value = event.currentTarget.value)}
        onChange={(event) => take(event.currentTarget.value)} onBlur={() => (typed.value = null)} />
      {slip && <span id={id} class="small off" role="alert">{slip}</span>}
    </label>
  );
}
