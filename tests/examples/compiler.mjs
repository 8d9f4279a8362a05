// The TypeScript compiler of client/node. It takes ten seconds for types that are not ours, so programs with the same options are judged at once.
import { execFile } from 'node:child_process';
import { writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const tools = fileURLToPath(new URL('../../client/node/node_modules', import.meta.url));
const always = ['--noEmit', '--strict', '--target', 'es2022', '--typeRoots', join(tools, '@types'), '--types', 'node'];

/** `programs`: texts by name. For each name a function tells what is wrong with that program, written into a folder: '' if nothing is. */
export function compiler(options, programs) {
  const names = Object.keys(programs);
  let errors; // of all, each from its file's name on

  async function judge(folder) {
    for (const name of names) await writeFile(join(folder, name), programs[name]);
    const args = [join(tools, 'typescript/bin/tsc'), ...always, ...options, ...names];
    return new Promise((resolve) => {
      execFile(process.execPath, args, { cwd: folder }, (failure, out, err) => {
        resolve(failure ? (out + err || failure.message).split(/^(?=\S)/m) : []);
      });
    });
  }

  const faults = (name) => async (folder) => {
    // An error of none of the programs, as in the package's types, is everybody's.
    const isOfAnother = (error) => names.some((other) => other !== name && error.startsWith(`${other}(`));
    return (await (errors ??= judge(folder))).filter((error) => !isOfAnother(error)).join('');
  };
  return Object.fromEntries(names.map((name) => [name, faults(name)]));
}
