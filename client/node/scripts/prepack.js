// Before npm packs: what the package needs and the repository keeps elsewhere, beside src/. The protos, the poses and the licence are copied; the
// messages' types are generated.
import { execFileSync } from 'node:child_process';
import { cpSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { api, literal } from '../src/protos.js';
import { withUnions } from './unions.js';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));

cpSync(at('../../../LICENSE'), at('../LICENSE'));
rmSync(at('../proto'), { recursive: true, force: true });
cpSync(at('../../poses'), at('../poses'), { recursive: true });
for (const folder of ['choreo', 'google']) cpSync(at(`../../../proto/${folder}`), at(`../proto/${folder}`), { recursive: true });

const types = at('../types');
rmSync(types, { recursive: true, force: true });
execFileSync(process.execPath, [
  createRequire(import.meta.url).resolve('@grpc/proto-loader/build/bin/proto-loader-gen-types.js'),
  '--grpcLib=@grpc/grpc-js',
  ...Object.entries(literal).map(([option, value]) => (value === String ? `--${option}=String` : `--${option}`)),
  '--includeComments',
  '--targetFileExtension=.d.ts',
  '--importFileExtension=.js',
  `--includeDirs=${at('../proto')}`,
  `--outDir=${types}`,
  'choreo/v1/choreography.proto',
]);

// Declarations hold no values, which the tool writes for enums all the same. What may be sent is other than the tool knows: src/check.js.
const messages = join(types, 'choreo/v1');
for (const name of readdirSync(messages)) {
  const text = readFileSync(join(messages, name), 'utf8').replace(/^\/\/ Original file: .*\n\n/, '');
  const declared = text.replace(/^export const (\w+) = \{\n([^}]*)\} as const;/gm, (_, type, values) => {
    return `export declare const ${type}: {\n${values.replace(/^( +)(\w+: '\w+'),$/gm, '$1readonly $2;')}};`;
  });
  const sendable = declared
    .replaceAll('(number | string | Long)', '(number | bigint | string | Long)')
    .replaceAll('(number | string)', 'number')
    .replace("'skeleton': (_choreo_v1_Skeleton__Output | null)", "'skeleton': _choreo_v1_Skeleton__Output") // which always comes
    .replace("'rotations'?: number[]", "'rotations'?: number[] | Float32Array | Float64Array")
    .replace('(Buffer | Uint8Array | string)', '(ArrayBuffer | ArrayBufferView)');
  const type = api.lookup('choreo.v1').nested[name.replace('.d.ts', '')];
  writeFileSync(join(messages, name), withUnions(sendable, type));
}

// All of them under their own names: those that are sent as they may be sent, the others as they come.
const sent = new Set();
function send(type) {
  if (sent.has(type)) return;
  sent.add(type);
  for (const { resolvedType } of type.fieldsArray ?? []) if (resolvedType) send(resolvedType);
}
const { Choreography, ...all } = api.lookup('choreo.v1').nested;
for (const { resolvedRequestType } of Choreography.methodsArray) send(resolvedRequestType);
const lines = Object.entries(all).map(
  ([name, type]) => `export type { ${sent.has(type) ? name : `${name}__Output as ${name}`} } from './choreo/v1/${name}.js';\n`,
);
writeFileSync(join(types, 'messages.d.ts'), lines.join(''));
