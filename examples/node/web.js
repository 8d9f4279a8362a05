// A page that watches a dance, drawn in lines, and changes it; backend.js does the work:
//   node web.js [--server HOST:PORT]... [--port 8080] [--seconds 60] [--speed 1]
import { serve } from './backend.js';

await serve((path) => (path === '/' ? new URL('web.html', import.meta.url) : undefined));
