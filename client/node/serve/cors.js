// Pages of other origins, which a browser lets ask only where the answer allows it.

const exposed = 'Choreo-Code, Retry-After';
const methods = 'GET, POST, DELETE';
const remembered = 7200; // seconds, the most that browsers take

/** Allows the pages of `origins` to read an answer. Returns whether the browser only asks if its page may, which is answered then. */
export function allow(origins, request, response) {
  if (origins.length === 0) return false;
  const { origin, 'access-control-request-headers': headers } = request.headers;
  response.setHeader('Vary', [response.getHeader('Vary') ?? [], 'Origin'].flat().join(', '));
  const isAllowed = origins.includes('*') || origins.includes(origin);
  if (isAllowed) {
    response.setHeader('Access-Control-Allow-Origin', origins.includes('*') ? '*' : origin);
    response.setHeader('Access-Control-Expose-Headers', exposed);
  }
  if (request.method !== 'OPTIONS') return false;
  const named = { 'Access-Control-Allow-Methods': methods, 'Access-Control-Max-Age': remembered, ...(headers && { 'Access-Control-Allow-Headers': headers }) };
  response.writeHead(204, isAllowed ? named : {}).end();
  return true;
}
