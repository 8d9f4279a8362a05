// After npm packed: a checkout reads the repository's own protos again.
import { rmSync } from 'node:fs';

for (const name of ['proto', 'poses', 'types', 'LICENSE']) rmSync(new URL(`../${name}`, import.meta.url), { recursive: true, force: true });
