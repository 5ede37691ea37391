// Shows a folder on this machine alone: node serve.js FOLDER PORT. A port that is taken is passed by.
import {createReadStream, statSync} from 'node:fs';
import {createServer} from 'node:http';
import {extname, resolve, sep} from 'node:path';

const KINDS = {'.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.css': 'text/css',
               '.wasm': 'application/wasm', '.glb': 'model/gltf-binary', '.svg': 'image/svg+xml',
               '.jsonl': 'application/jsonl', '.gz': 'application/gzip'};
const folder = resolve(process.argv[2]);
let port = Number(process.argv[3]);

const server = createServer((request, response) => {
  const {pathname} = new URL(request.url, 'http://localhost');
  let path = resolve(folder, `.${decodeURIComponent(pathname)}`);
  const stat = (at) => statSync(at, {throwIfNoEntry: false});
  if (stat(path)?.isDirectory()) path = resolve(path, 'index.html');
  if (!path.startsWith(folder + sep) || !stat(path)?.isFile()) {
    response.writeHead(404).end();
    return;
  }
  response.writeHead(200, {'Content-Type': KINDS[extname(path)] ?? 'text/plain',
                           'Cache-Control': 'no-cache'});
  createReadStream(path).pipe(response);
});
server.on('error', (error) => {
  if (error.code !== 'EADDRINUSE') throw error;
  server.listen(++port, '127.0.0.1');
});
server.on('listening', () => console.log(`http://localhost:${port}/`));
server.listen(port, '127.0.0.1');
