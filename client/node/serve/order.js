// Checks a back end's order. For its fields see DanceOrder in index.d.ts.
import { checked } from '../src/check.js';
import { invalid } from '../src/error.js';
import { isObject } from '../src/fields.js';
import { hint, quoted } from '../src/words.js';

const names = ['seconds', 'music', 'config', 'keys', 'speed'];

/** Throws ChoreoError, which names the field, for an invalid order. */
export function requireOrder(order) {
  if (!isObject(order)) throw invalid('order', `${quoted(order)} is no {${names.join(', ')}}`);
  for (const name of Object.keys(order)) if (!names.includes(name)) throw invalid(name, `no field of an order; ${hint(name, names)}`);
  requirePositive('seconds', order.seconds);
  requirePositive('speed', order.speed ?? 1);
  if (typeof order.music === 'string') throw invalid('music', `${quoted(order.music)} is text; give the file's bytes, as readFile() does`);
  checked('StreamDanceRequest', { config: order.config ?? {} }, 'order');
}

function requirePositive(name, value) {
  if (!(value > 0 && Number.isFinite(value))) throw invalid(name, `${quoted(value)} is not a number above 0`);
}
