// Where the page is served with relievo.webmanifest and relievo-offline.js beside it, browsers offer to install it.
if (location.protocol.startsWith("http")) {
  const link = document.createElement("link");
  link.rel = "manifest";
  link.href = "relievo.webmanifest";
  document.head.append(link);
  navigator.serviceWorker?.register("relievo-offline.js").catch(() => {}); // it is not there, or not allowed
}
