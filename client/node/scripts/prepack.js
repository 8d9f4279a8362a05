// Before npm packs: what the package needs and the repository keeps elsewhere, beside src/. The protos and the licence are copied; the
// messages' types are generated.
import { execFileSync } from 'node:child_process';
import { cpSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { literal } from '../src/protos.js';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));

cpSync(at('../../../LICENSE'), at('../LICENSE'));
rmSync(at('../proto'), { recursive: true, force: true });
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

// Declarations hold no values, which the tool writes for enums all the same.
const messages = join(types, 'choreo/v1');
for (const name of readdirSync(messages)) {
  const text = readFileSync(join(messages, name), 'utf8');
  const declared = text.replace(/^export const (\w+) = \{\n([^}]*)\} as const;/gm, (_, type, values) => {
    return `export declare const ${type}: {\n${values.replace(/^( +)(\w+: '\w+'),$/gm, '$1readonly $2;')}};`;
  });
  writeFileSync(join(messages, name), declared.replace(/^\/\/ Original file: .*\n\n/, ''));
}
