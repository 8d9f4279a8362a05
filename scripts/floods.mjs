#!/usr/bin/env node
// Floods a choreod of its own with calls and connections that cost it something but are no dances, and prints its threads and memory
// before, during and after. Takes a minute.
//   npm ci --prefix client/node && node scripts/floods.mjs build/release/bin/choreod [FLAG...]
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { connect } from 'node:net';
import { createInterface } from 'node:readline';
import { setTimeout as sleep } from 'node:timers/promises';

const grpc = createRequire(new URL('../client/node/package.json', import.meta.url))('@grpc/grpc-js');
const calls = 600, connections = 400, channels = 10;
const [program, ...flags] = process.argv.slice(2);
const server = spawn(program, ['--listen', '127.0.0.1:0', '--log-level', 'off', ...flags], { stdio: ['ignore', 'pipe', 'inherit'] });

function look(what) {
  const status = readFileSync(`/proc/${server.pid}/status`, 'utf8');
  const figure = (name) => Number(new RegExp(`^${name}:\\s+(\\d+)`, 'm').exec(status)[1]);
  console.log(`${what}: ${figure('Threads')} threads, ${Math.round(figure('VmRSS') / 1024)} MiB`);
}

/** Opens calls that never end by themselves. `request`: the bytes of their first message. */
async function keepCalling(address, path, request) {
  const asIs = (bytes) => bytes;
  const options = { 'grpc.use_local_subchannel_pool': 1 }; // a connection each
  const clients = Array.from({ length: channels }, () => new grpc.Client(address, grpc.credentials.createInsecure(), options));
  const open = Array.from({ length: calls }, (_, at) => clients[at % channels].makeBidiStreamRequest(path, asIs, asIs));
  let answered = 0;
  for (const call of open) {
    call.on('error', () => {}).on('data', () => ++answered);
    call.write(request);
  }
  for (let second = 0; second < 60 && answered < calls; ++second) await sleep(1000);
  look(`${calls} open calls of ${path}, ${answered} answers`);
  open.forEach((call) => call.cancel());
  await sleep(10000);
  clients.forEach((client) => client.close());
  look('10 s later');
}

async function keepSilent(port) {
  const ends = [];
  for (let at = 0; at < connections; ++at) {
    const socket = connect(port, '127.0.0.1').on('error', () => {}).resume();
    ends.push(once(socket, 'close'));
    if (at % 40 === 39) await sleep(700); // an address may make 64 a second
  }
  look(`${connections} connections without a byte`);
  await Promise.all(ends);
  look('all of them ended by the server');
}

try {
  let address;
  for await (const line of createInterface({ input: server.stdout })) if ((address = /listens on (\S+)/.exec(line)?.[1])) break;
  server.stdout.resume();
  look('idle');
  await keepCalling(address, '/grpc.health.v1.Health/Watch', Buffer.alloc(0));
  await keepCalling(address, '/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo', Buffer.from([0x3a, 0])); // list_services
  await keepSilent(Number(address.split(':')[1]));
} finally {
  server.kill('SIGKILL');
}
