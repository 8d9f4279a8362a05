// Checks a back end's order. For its fields see DanceOrder in index.d.ts.
import { checked } from '../src/check.js';
import { invalid } from '../src/error.js';
import { isObject } from '../src/fields.js';
import { hint, quoted } from '../src/words.js';

const names = ['seconds', 'music', 'config', 'keys', 'speed'];
/** Fields of a config that serveDance() sets itself, and what to do instead. */
const ownFields = {
  frames: 'say seconds',
  encoding: 'pages get quaternions',
  generate_until: "the page's clock says it",
  reject_invalid_keys: 'it is always true',
};
/** Requests that serveDance() sends itself, and what to do instead. */
const ownRequests = {
  config: "it is the order's config",
  generate_until: ownFields.generate_until,
  keyframes_complete: 'it comes at the end',
};
const mostSeconds = 3600; // of a dance: 108 000 frames

/** Throws ChoreoError, which names the field, for an invalid order. */
export function requireOrder(order) {
  if (!isObject(order)) throw invalid('order', `${quoted(order)} is not {${names.join(', ')}}`);
  for (const [name, value] of Object.entries(order)) {
    if (!names.includes(name)) throw invalid(name, `no field of an order; ${hint(name, names)}`);
    if (value === null) throw invalid(name, 'is null; leave it out');
  }
  requirePositive('seconds', order.seconds);
  if (order.seconds > mostSeconds) throw invalid('seconds', `${order.seconds} s is more than an hour, ${mostSeconds} s`);
  requirePositive('speed', order.speed ?? 1);
  requireMusic(order.music ?? []);
  const { config = {}, keys = [] } = order;
  checked('StreamDanceRequest', { config }, 'order');
  for (const [name, instead] of Object.entries(ownFields)) if (name in config) throw invalid(`config.${name}`, `is not yours to set: ${instead}`);
  requireKeys(keys);
}

/** Whether music is a file's bytes, and not requests. */
export const isFile = (music) => ArrayBuffer.isView(music) || music instanceof ArrayBuffer;

function requireMusic(music) {
  if (typeof music === 'string') throw invalid('music', `${quoted(music)} is text; give the file's bytes, as readFile() does`);
  if (isFile(music) || music[Symbol.iterator] || music[Symbol.asyncIterator]) return;
  throw invalid('music', `${quoted(music)} is neither a file's bytes, as readFile() gives them, nor requests with music, one after the other`);
}

/** Requests before the dance begins. */
function requireKeys(keys) {
  if (!Array.isArray(keys)) throw invalid('keys', `${quoted(keys)} is not a list of requests, as readKeys() gives it`);
  keys.forEach((key, at) => {
    try {
      checked('StreamDanceRequest', key, '');
    } catch ({ violations: [{ field, description }] }) {
      throw invalid(`keys[${at}]${field && `.${field}`}`, description);
    }
    for (const [name, instead] of Object.entries(ownRequests)) if (key[name]) throw invalid(`keys[${at}].${name}`, `is not yours to say: ${instead}`);
  });
}

function requirePositive(name, value) {
  if (!(value > 0 && Number.isFinite(value))) throw invalid(name, `${quoted(value)} is not a number above 0`);
}
