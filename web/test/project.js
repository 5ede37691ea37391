// A fresh project into which the packed package is installed, as a user does it, and a browser.
import {execFileSync} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {createServer} from 'node:http';
import {tmpdir} from 'node:os';
import {delimiter, join} from 'node:path';
import {fileURLToPath} from 'node:url';

import {chromium} from 'playwright-core';

const folder = fileURLToPath(new URL('..', import.meta.url));
const BROWSERS = ['chromium', 'chromium-browser', 'google-chrome'];
/** A machine may have other things to do. */
const LONGEST_MS = 180e3;

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
  const folders = (process.env.PATH ?? '').split(delimiter);
  return BROWSERS.flatMap((name) => folders.map((place) => join(place, name))).find(existsSync) ?? null;
}

/** Runs a page of a project in a browser without a display, until it calls `send(result)`. */
export async function runInBrowser(program, project, page) {
  const server = createServer((request, response) => {
    const path = new URL(request.url, 'http://localhost').pathname;
    const type = {js: 'text/javascript', wasm: 'application/wasm'}[path.split('.').pop()];
    try {
      const content = path === '/' ? page : readFileSync(join(project, path));
      response.writeHead(200, {'content-type': type ?? 'text/html'}).end(content);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const running = await chromium.launch({
    executablePath: program, timeout: LONGEST_MS,
    args: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-gpu-sandbox']});
  let timer;
  try {
    const tab = await running.newPage();
    return await new Promise((done, fail) => {
      timer = setTimeout(() => fail(new Error(`${program}: no result in ${LONGEST_MS / 1e3} s`)), LONGEST_MS);
      tab.on('crash', () => fail(new Error(`${program}: the page is gone`)));
      tab.exposeFunction('send', done)
        .then(() => tab.goto(`http://localhost:${server.address().port}/`, {timeout: LONGEST_MS}))
        .catch(fail);
    });
  } finally {
    clearTimeout(timer);
    await running.close();
    server.closeAllConnections();
    server.close();
  }
}
