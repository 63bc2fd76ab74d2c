// Writes files completely or not at all.
import fs from "node:fs";

// Writes a file under an unused name in the folder of `name`, and adds that name to `made`.
function writeBeside(name, bytes, made) {
  for (let i = 0; ; i++) {
    const temporary = `${name}.relievo-${process.pid}-${i}`;
    let file;
    try {
      file = fs.openSync(temporary, "wx");
    } catch (error) {
      if (error.code === "EEXIST") continue;
      throw error;
    }
    made.push(temporary);
    fs.writeFileSync(file, bytes);
    fs.closeSync(file);
    return;
  }
}

// Writes all files, [[name, bytes], ...], or none of them. First writes them under temporary names. After an error it
// removes only files that it has made itself.
export function writeAll(files) {
  const made = [];
  try {
    for (const [name, bytes] of files) writeBeside(name, bytes, made);
    for (const [name] of files) {
      fs.renameSync(made[0], name);
      made.shift();
    }
  } catch (error) {
    made.forEach((name) => fs.rmSync(name, { force: true }));
    throw error;
  }
}
