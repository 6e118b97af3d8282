// The VSIX that has the server in it, on a machine on which nothing else is: no setting, nothing on the PATH.

import type { WindowChecks } from "./checks";
import { FILLET } from "./drawings";
import { Host } from "./host";
import { Window } from "./window";

export async function withServer(checks: WindowChecks): Promise<void> {
  const host = await Host.start({}, { "plate.dxf": FILLET }, { path: "/usr/bin:/bin", withServer: true });
  const window = new Window(host.page);
  checks.page = host.page;
  try {
    await checks.check("the server in the VSIX is found and runs", async () => {
      await window.openOurs("plate.dxf");
      await window.squiggles.first().waitFor();
      await checks.shot("with-server");
    });
  } finally {
    await host.stop();
  }
}
