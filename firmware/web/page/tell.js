// Sends a wish to the server and says it when it counts for nothing.
import { send } from "./socket.js";
import { toast } from "./toast.js";
import { say } from "./words.js";

/// True when it was accepted.
export async function tell(action, keys = {}) {
  const verdict = await send(action, keys);
  if (verdict !== "accepted") toast(say(`verdict.${verdict}`));
  return verdict === "accepted";
}
