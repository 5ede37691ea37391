// A fresh project into which the packed package is installed, as a user does it, and a browser.
import {execFileSync, spawn} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {rm} from 'node:fs/promises';
import {createServer} from 'node:http';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';

const folder = fileURLToPath(new URL('..', import.meta.url));
const BROWSERS = ['chromium', 'chromium-browser', 'google-chrome'];
const LONGEST_MS = 60e3;

/** The project's folder, and `run` for commands in it. `others` are of this package's modules. */
export function freshProject(others = []) {
  const project = mkdtempSync(join(tmpdir(), 'nade-project-'));
  const run = (command, ...values) =>
    execFileSync(command, values, {cwd: project, encoding: 'utf8'});
  const packed = execFileSync('npm', ['pack', '--silent', '--pack-destination', project],
                              {cwd: folder, encoding: 'utf8'}).trim();
  writeFileSync(join(project, 'package.json'), '{"name":"fresh","type":"module"}');
  run('npm', 'install', '--silent', '--offline', '--no-audit', `./${packed}`,
      ...others.map((name) => moduleOf(name)));
  return {project, run, remove: () => rmSync(project, {recursive: true})};
}

export const moduleOf = (name) => join(folder, 'node_modules', name);

/** The browser of this machine, or null. */
export function browser() {
  return BROWSERS.find((name) => {
    try {
      execFileSync(name, ['--version'], {stdio: 'ignore'});
      return true;
    } catch {
      return false;
    }
  }) ?? null;
}

/**
 * Runs a page of a project in a browser without a display, until it sends its result:
 * `fetch('/result', {method: 'POST', body: JSON.stringify(…)})`.
 */
export async function runInBrowser(program, project, page) {
  const profile = mkdtempSync(join(tmpdir(), 'nade-browser-'));
  let server;
  let running;
  try {
    return await new Promise((done, fail) => {
      server = createServer((request, response) => {
        const path = new URL(request.url, 'http://localhost').pathname;
        if (request.method === 'POST') {
          const parts = [];
          request.on('data', (part) => parts.push(part));
          request.on('end', () => done(JSON.parse(Buffer.concat(parts).toString())));
          response.end();
          return;
        }
        const type = {js: 'text/javascript', wasm: 'application/wasm'}[path.split('.').pop()];
        try {
          const content = path === '/' ? page : readFileSync(join(project, path));
          response.writeHead(200, {'content-type': type ?? 'text/html'}).end(content);
        } catch {
          response.writeHead(404).end();
        }
      }).listen(0, '127.0.0.1', () => {
        running = spawn(program, [
          '--headless=new', '--no-sandbox', '--use-angle=swiftshader',
          '--enable-unsafe-swiftshader', '--disable-gpu-sandbox', '--no-first-run',
          `--user-data-dir=${profile}`, `http://127.0.0.1:${server.address().port}/`,
        ], {stdio: 'ignore', detached: true});
        running.on('exit', (code) => fail(new Error(`${program}: stopped with ${code}`)));
        setTimeout(() => fail(new Error(`${program}: no result in ${LONGEST_MS / 1e3} s`)),
                   LONGEST_MS).unref();
      });
    });
  } finally {
    const gone = running && new Promise((done) => running.on('exit', done));
    if (running?.exitCode === null) process.kill(-running.pid, 'SIGKILL');  // and its children
    await gone;
    server?.closeAllConnections();
    server?.close();
    await rm(profile, {recursive: true, force: true, maxRetries: 5, retryDelay: 200});
  }
}
