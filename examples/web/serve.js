// A page on which a character dances; ../node/backend.js does the work:
//   node serve.js [--server HOST:PORT]... [--port 8080] [--seconds 60] [--speed 1]
import { serve } from '../node/backend.js';

const own = { '/': 'index.html', '/page.js': 'page.js', '/stage.js': 'stage.js' };
/** Of installed packages, what the page's import map names. No "..": a URL has none left in its path. */
const packaged = /^\/(three\/(?:build|examples\/jsm)|choreo-client\/(?:character|page))\/[\w./-]+\.js$/;

await serve((path) => {
  if (own[path]) return new URL(own[path], import.meta.url);
  return packaged.test(path) ? new URL(`node_modules${path}`, import.meta.url) : undefined;
});
