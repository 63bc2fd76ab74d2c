// The service worker of a page from a server. It stores the page, so that the page opens without a network.
const NAME = "relievo";

addEventListener("install", (event) => event.waitUntil(skipWaiting()));
addEventListener("activate", (event) => event.waitUntil(clients.claim()));

// Answers with the newest page if the server responds, otherwise with the stored page.
addEventListener("fetch", (event) => {
  const isPage = event.request.mode === "navigate" || event.request.url.endsWith(".webmanifest");
  if (event.request.method === "GET" && isPage) event.respondWith(newest(event.request));
});

async function newest(request) {
  const kept = await caches.open(NAME);
  try {
    const answer = await fetch(request);
    if (answer.ok) await kept.put(request, answer.clone());
    return answer;
  } catch {
    return (await kept.match(request, {ignoreSearch: true})) ?? Response.error();
  }
}
