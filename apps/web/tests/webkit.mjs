// Drives WebKit by WebDriver: Debian's webkit2gtk-driver with its MiniBrowser, on a display of Xvfb. No npm package can
// do that.
import {spawn} from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import {eventually} from "./support.mjs";

const BROWSER = "/usr/lib/x86_64-linux-gnu/webkit2gtk-4.1/MiniBrowser";
const ELEMENT = "element-6066-11e4-a52e-4f735466cecf"; // WebDriver's key for the identifier of an element

// Returns the reason why the tests in WebKit cannot run; false if they can.
export function missingWebKit() {
  const lacks = ["/usr/bin/xvfb-run", "/usr/bin/WebKitWebDriver", BROWSER].find((file) => !fs.existsSync(file));
  return lacks ? `SKIPPED: ${lacks} is not there: run scripts/prepare --web` : false;
}

export class WebKitPage {
  // Opens the address in a new browser. Its downloads are stored in `folder`.
  static async open(t, address, folder) {
    const port = 20000 + process.pid % 20000;
    const driver = spawn("xvfb-run", ["-a", "WebKitWebDriver", `--port=${port}`], {
      env: {...process.env, HOME: folder, XDG_CONFIG_HOME: folder}, stdio: "ignore", detached: true,
    });
    const page = new WebKitPage();
    page.folder = folder;
    t.after(async () => {
      await page.#command("DELETE", "").catch(() => {}); // the session may have ended already
      process.kill(-driver.pid);
    });
    page.address = `http://127.0.0.1:${port}`;
    await eventually(() => page.#command("GET", "/status").catch(() => null));
    const capabilities = {alwaysMatch: {"webkitgtk:browserOptions": {binary: BROWSER, args: ["--automation"]}}};
    const {sessionId} = await page.#command("POST", "/session", {capabilities});
    page.address += `/session/${sessionId}`;
    await page.#command("POST", "/window/rect", {width: 1280, height: 900});
    await page.#command("POST", "/url", {url: address});
    return page;
  }

  async #command(method, place, body) {
    const response = await fetch(this.address + place, {method, body: body && JSON.stringify(body)});
    const {value} = await response.json();
    if (value?.error) throw new Error(`${method} ${place}: ${value.error}: ${value.message}`);
    return value;
  }

  async #element(selector) {
    return (await this.#command("POST", "/element", {using: "css selector", value: selector}))[ELEMENT];
  }

  run(script, ...args) {
    return this.#command("POST", "/execute/sync", {script, args});
  }

  // Types into a field, or gives the paths of files to a file field.
  async type(selector, text) {
    await this.#command("POST", `/element/${await this.#element(selector)}/value`, {text});
  }

  reload() {
    return this.#command("POST", "/refresh", {});
  }

  async click(selector) {
    await this.#command("POST", `/element/${await this.#element(selector)}/click`, {});
  }

  untilThereIs(selector) {
    return eventually(() => this.run("return document.querySelector(arguments[0]) !== null", selector), 120);
  }

  untilSaid(pattern) {
    return eventually(() => this.run("return new RegExp(arguments[0]).test(document.body.innerText)", pattern), 120);
  }

  // Waits until a file that the page saves stops growing. Returns its path.
  saved(name) {
    const file = path.join(this.folder, name);
    let size = 0;
    return eventually(() => {
      const before = size;
      size = fs.existsSync(file) ? fs.statSync(file).size : 0;
      return size > 0 && size === before && file;
    });
  }
}
