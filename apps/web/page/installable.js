// Makes browsers offer to install the page, if a server also provides relievo.webmanifest and relievo-offline.js.
if (location.protocol.startsWith("http")) {
  const link = document.createElement("link");
  link.rel = "manifest";
  link.href = "relievo.webmanifest";
  document.head.append(link);
  navigator.serviceWorker?.register("relievo-offline.js").catch(() => {}); // the file is missing or forbidden
}
