// Makes browsers offer to install the page if it is served with relievo.webmanifest and relievo-offline.js beside it.
if (location.protocol.startsWith("http")) {
  const link = document.createElement("link");
  link.rel = "manifest";
  link.href = "relievo.webmanifest";
  document.head.append(link);
  navigator.serviceWorker?.register("relievo-offline.js").catch(() => {}); // the file is missing or forbidden
}
