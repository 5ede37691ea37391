// The page without a network: what was loaded once is kept, and used where the network has nothing.
const CACHE = 'nade';
const FIRST = [];

self.addEventListener('install', (event) => {
  self.skipWaiting();
  event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll(['./', ...FIRST])));
});
self.addEventListener('activate', (event) => event.waitUntil(self.clients.claim()));
self.addEventListener('fetch', (event) => {
  const {request} = event;
  if (request.method !== 'GET' || new URL(request.url).origin !== location.origin) return;
  event.respondWith(fetch(request).then((response) => {
    if (response.ok) {
      const kept = response.clone();
      event.waitUntil(caches.open(CACHE).then((cache) => cache.put(request, kept)));
    }
    return response;
  }, () => caches.match(request).then((kept) => kept ?? Response.error())));
});
