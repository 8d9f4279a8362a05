// Checks requests against the API's descriptors, because protobufjs silently drops or converts invalid fields.
import { types } from 'node:util';
import protobuf from 'protobufjs';
import { jointAt } from './as_sent.js';
import { invalid } from './error.js';
import { requireWellFormed } from './fields.js';
import { hint, quoted } from './words.js';
import { api } from './protos.js';

/** Ranges of integer types. */
const ranges = {
  int32: [-(2n ** 31n), 2n ** 31n - 1n],
  uint32: [0n, 2n ** 32n - 1n],
  int64: [-(2n ** 63n), 2n ** 63n - 1n],
  uint64: [0n, 2n ** 64n - 1n],
};

/** The size limit of a message in bytes, as in Limits.max_message_bytes, and the bytes around the music in its message. */
const mostBytes = 16 << 20;
const aroundMusic = 32;

const largestFloat = 3.4028235e38;

/** The typed array whose bytes are in this encoding. */
const samples = { AUDIO_ENCODING_PCM_F32LE: 'Float32Array', AUDIO_ENCODING_PCM_S16LE: 'Int16Array' };

/**
 * Returns a copy, for the stub, of `value`, a message of the API's `type`. Throws ChoreoError, naming the field's path, the value and what is
 * allowed. `name`: the message's name in errors. `encoding`: that of any music in the message.
 */
export function checked(type, value, name, encoding) {
  try {
    return message(api.lookupType(`choreo.v1.${type}`), value, '', name, encoding);
  } catch (error) {
    for (const violation of error.violations ?? []) {
      const joint = jointAt(violation.field, value);
      if (joint !== undefined) violation.joint = joint;
    }
    throw error;
  }
}

/** Throws for number `at` of a dance's requests if it has no field. */
export function requireKind(request, at) {
  if (Object.keys(request).length > 0) return;
  throw invalid(`requests[${at}]`, `is empty; there are ${Object.keys(api.lookupType('choreo.v1.StreamDanceRequest').fields).join(', ')}`);
}

/** Throws for `audio` that is too large for a message. `remedy`: the error's advice. */
export function requireSendable(audio, remedy) {
  const size = audio?.data?.length ?? 0;
  if (size + aroundMusic <= mostBytes) return;
  const inMiB = (size / 2 ** 20).toFixed(1);
  throw invalid('audio.data', `${inMiB} MiB; a message has at most ${mostBytes / 2 ** 20} MiB in all: ${remedy}`);
}

function message(type, value, path, name, encoding) {
  const names = Object.keys(type.fields);
  if (typeof value !== 'object' || value === null || Symbol.iterator in value || types.isPromise(value)) {
    throw invalid(path || name, `${quoted(value)} is not a ${type.name}, {${names.join(', ')}}`);
  }
  const copy = {};
  const chosen = {}; // of each oneof
  for (const [key, one] of Object.entries(value)) {
    if (Object.hasOwn(type.oneofs ?? {}, key) && typeof one !== 'object') continue; // an answer's oneof member names the present field
    const at = path ? `${path}.${key}` : key;
    if (!Object.hasOwn(type.fields, key)) throw invalid(at, `no field of ${type.name}; ${hint(key, names)}`);
    if (one === undefined || one === null) continue;
    const field = type.fields[key];
    const oneof = field.partOf;
    if (oneof && chosen[oneof.name]) {
      throw invalid(at, `given beside ${chosen[oneof.name]}; there is one of ${oneof.oneof.join(', ')}`);
    }
    if (oneof) chosen[oneof.name] = key;
    copy[key] = field.repeated ? list(field, one, at, encoding) : single(field, one, at, encoding);
  }
  return copy;
}

function list(field, value, path, encoding) {
  const isOfNumbers = !field.resolvedType && ArrayBuffer.isView(value) && typeof value[Symbol.iterator] === 'function';
  if (!Array.isArray(value) && !isOfNumbers) throw invalid(path, `${quoted(value)} is not an array`);
  if (!field.resolvedType && Array.isArray(value[0])) throw invalid(`${path}[0]`, `${quoted(value[0])} is not a number; ${field.name} is one flat list: give lists.flat()`);
  return Array.from(value, (one, index) => single(field, one, `${path}[${index}]`, encoding));
}

function single(field, value, path, encoding) {
  const { type, resolvedType } = field;
  if (resolvedType instanceof protobuf.Enum) return label(resolvedType, value, path);
  if (resolvedType) return message(resolvedType, value, path, path, encoding);
  if (type === 'bytes') return bytes(value, path, encoding);
  if (type in ranges) return whole(type, value, path);
  if (type === 'double' || type === 'float') return real(type, value, path);
  const wanted = type === 'bool' ? 'boolean' : type;
  if (typeof value !== wanted) throw invalid(path, `${quoted(value)} is not a ${wanted}`);
  if (type === 'string') requireWellFormed(value, path);
  return value;
}

function label({ name, values }, value, path) {
  if (Object.hasOwn(values, value) || Object.values(values).includes(value)) return value;
  throw invalid(path, `${quoted(value)} is not a ${name}; ${hint(String(value), Object.keys(values))}`);
}

function real(type, value, path) {
  if (!Number.isFinite(value)) throw invalid(path, `${quoted(value)} is not a finite number`);
  if (type === 'float' && Math.abs(value) > largestFloat) throw invalid(path, `${value} is beyond the numbers of 32 bits, which end at 3.4e38`);
  return value;
}

function whole(type, value, path) {
  const [least, most] = ranges[type];
  const isLong = typeof value === 'object' && value !== null && 'low' in value && 'high' in value; // of the package "long"
  const isText = most > 2n ** 32n && typeof value === 'string' && /^-?\d+$/.test(value);
  const number = Number.isSafeInteger(value) || typeof value === 'bigint' || isText || isLong ? BigInt(String(value)) : undefined;
  if (number >= least && number <= most) return typeof value === 'number' ? value : String(value);
  // The server knows the field's own limits, which are narrower than those of its type.
  if (number < least) throw invalid(path, `${quoted(value)} is less than ${least}`);
  if (number > most) throw invalid(path, `${quoted(value)} is more than ${most}`);
  throw invalid(path, `${quoted(value)} is not a whole number${Number.isInteger(value) ? '; numbers above 2^53 go as text' : ''}`);
}

function bytes(value, path, encoding) {
  if (types.isUint8Array(value)) return value;
  if (types.isAnyArrayBuffer(value)) return new Uint8Array(value);
  if (!ArrayBuffer.isView(value)) {
    const text = typeof value === 'string' ? '; of a file readFile() gives them, of base64 Buffer.from()' : '';
    throw invalid(path, `${quoted(value)} is not bytes: a Uint8Array, an ArrayBuffer or the encoding's samples${text}`);
  }
  const kind = value.constructor.name;
  const known = api.lookupEnum('choreo.v1.AudioEncoding').valuesById[encoding] ?? encoding;
  if ((value.BYTES_PER_ELEMENT ?? 1) > 1 && samples[known] !== kind) {
    throw invalid(path, `${kind} is not what config.audio_format.encoding says, ${known}: that is ${samples[known] ?? 'Uint8Array'} or any bytes`);
  }
  return new Uint8Array(value.buffer, value.byteOffset, value.byteLength);
}
