// Starts `stdc-slam run --view` on a free port and tells its link.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export async function startRun(program, sequence, options = []) {
  const out = mkdtempSync(join(tmpdir(), "stdc-view-"));
  const child = spawn(program, ["run", sequence, "--output", join(out, "results"), "--view", "0", "--view-wait", ...options],
    { stdio: ["ignore", "ignore", "pipe"] });
  let errors = "";
  const ended = new Promise((resolve) => child.on("exit", (code, signal) => resolve({ code, signal })));
  const link = await new Promise((resolve, reject) => {
    child.stderr.on("data", (data) => {
      errors += data;
      const found = /live view at (\S+)/.exec(errors);
      if (found) resolve(found[1]);
    });
    ended.then(() => reject(new Error(`stdc-slam has ended: ${errors}`)));
  });
  return { link, ended, out, results: join(out, "results"), errors: () => errors,
    async stop() {
      child.kill("SIGKILL");
      await ended;
      rmSync(out, { recursive: true, force: true });
    } };
}
