#!/usr/bin/env node
// Floods a choreod of its own with calls and connections that cost it something but are no dances, and with songs as large files. Prints its
// threads and memory before, during and after. Takes two minutes.
//   npm ci --prefix client/node && node scripts/floods.mjs build/release/bin/choreod [FLAG...]
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { connect } from 'node:net';
import { createInterface } from 'node:readline';
import { setTimeout as sleep } from 'node:timers/promises';
import { ChoreoClient } from '../client/node/src/index.js';

const grpc = createRequire(new URL('../client/node/package.json', import.meta.url))('@grpc/grpc-js');
const calls = 600, connections = 400, channels = 10;
const files = 20, fileMib = 96;
const [program, ...flags] = process.argv.slice(2);
const server = spawn(program, ['--listen', '127.0.0.1:0', '--log-level', 'off', ...flags], { stdio: ['ignore', 'pipe', 'inherit'] });

function look(what) {
  const status = readFileSync(`/proc/${server.pid}/status`, 'utf8');
  const figure = (name) => Number(new RegExp(`^${name}:\\s+(\\d+)`, 'm').exec(status)[1]);
  const [now, most] = ['VmRSS', 'VmHWM'].map((name) => Math.round(figure(name) / 1024));
  console.log(`${what}: ${figure('Threads')} threads, ${now} MiB, ${most} at most so far`);
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

/** A WAV file of silence: 48 000 Hz, stereo, floats. */
function silence(bytes) {
  const file = Buffer.alloc(bytes);
  file.write('RIFF');
  file.writeUInt32LE(bytes - 8, 4);
  file.write('WAVEfmt ', 8);
  for (const [at, value] of [[16, 16], [24, 48000], [28, 8 * 48000], [40, bytes - 44]]) file.writeUInt32LE(value, at);
  for (const [at, value] of [[20, 3], [22, 2], [32, 8], [34, 32]]) file.writeUInt16LE(value, at);
  file.write('data', 36);
  return file;
}

/** Sends files at once, most of which the server has no room for. */
async function sendFiles(address) {
  const file = silence(fileMib << 20);
  const order = function* () {
    yield { config: { frames: 30, audio_format: { encoding: 'AUDIO_ENCODING_FILE' } } };
    for (let at = 0; at < file.length; at += 1 << 20) yield { audio: { data: file.subarray(at, at + (1 << 20)) } };
    yield { end_of_audio: {} };
    yield { keyframes_complete: {} };
  };
  const send = async () => {
    const client = new ChoreoClient(address, { retry: 0 });
    try {
      for await (const { summary } of client.streamDance(order())) if (summary) return 'danced';
    } catch ({ code }) {
      return code;
    } finally {
      client.close();
    }
  };
  const ends = await Promise.all(Array.from({ length: files }, send));
  const danced = ends.filter((end) => end === 'danced').length;
  const others = [...new Set(ends)].filter((end) => end !== 'danced').join(', ');
  look(`${files} files of ${fileMib} MiB at once, ${danced} danced to, the others ${others}`);
  await sleep(10000);
  look('10 s later');
}

try {
  let address;
  for await (const line of createInterface({ input: server.stdout })) if ((address = /listens on (\S+)/.exec(line)?.[1])) break;
  server.stdout.resume();
  look('idle');
  await keepCalling(address, '/grpc.health.v1.Health/Watch', Buffer.alloc(0));
  await keepCalling(address, '/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo', Buffer.from([0x3a, 0])); // list_services
  await keepSilent(Number(address.split(':')[1]));
  await sendFiles(address);
} finally {
  server.kill('SIGKILL');
}
