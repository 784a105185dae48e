// node send_osc.mjs WORDS.json: sends its packets by node-osc, which makes whole numbers integers.
import { readFileSync } from "node:fs";
import { Bundle, Client, Message } from "node-osc";

const { port, packets } = JSON.parse(readFileSync(process.argv[2], "utf8"));
const client = new Client("127.0.0.1", port);
for (const packet of packets) {
  const messages = packet.map(([address, ...args]) => new Message(address, ...args));
  await client.send(messages.length === 1 ? messages[0] : new Bundle(...messages));
}
await client.close();
