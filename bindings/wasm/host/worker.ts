// A module worker: `new Worker(..., { type: "module" })` of this file, for FarEngine.

import type { Far } from "./far_engine.js";
import { serve } from "./serve.js";

serve(globalThis as unknown as Far);
