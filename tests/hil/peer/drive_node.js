// drive_node.js EDS NODE_ID: a CANopen node by the npm package `canopen`, made from an EDS. Frames come by standard input and go by standard
// output, a line each, ID#DATA in hexadecimal; when standard input ends, a line of JSON on standard error says what the node saw.
//
// The package is the stack: object dictionary, SDO server, NMT, heartbeats, SYNC, PDOs. What is here makes it a device: its boot-up
// message, which the package leaves to the application, the mode that it shows, and a position that follows the target.
'use strict';

const fs = require('fs');
const os = require('os');
const path = require('path');
const readline = require('readline');
const { Device, Eds, NmtState } = require('canopen');

const STATUSWORD = 0x0231; // Ready to Switch On, voltage, remote

/** The EDS for one node-id: the package reads no formulas. */
function ofNode(file, nodeId) {
    const text = fs.readFileSync(file, 'latin1').replace(
        /\$NODEID\s*\+\s*(0x[0-9A-Fa-f]+|[0-9]+)/g, (_, base) => '0x' + (Number(base) + nodeId).toString(16));
    const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'ivo-peer.'));
    try {
        const instance = path.join(folder, 'node.eds');
        fs.writeFileSync(instance, text, 'latin1');
        return Eds.fromFile(instance);
    } finally {
        fs.rmSync(folder, { recursive: true });
    }
}

const [file, id] = process.argv.slice(2);
const nodeId = Number(id);
const device = new Device({ id: nodeId, eds: ofNode(file, nodeId) });
const seen = { syncs: 0, commands: [], states: [], master: [] };

function send({ id: cobId, data }) {
    process.stdout.write(`${cobId.toString(16)}#${data.toString('hex')}\n`);
}

let previous = NmtState.INITIALIZING;
device.addListener('message', send);
device.start();
device.nmt.addListener('changeState', announce);
device.nmt.addListener('heartbeat', ({ deviceId, state }) => seen.master.push([deviceId, state]));
device.sync.addListener('sync', () => { seen.syncs += 1; });
device.pdo.addListener('pdo', ({ cobId, dataObjects }) => {
    seen.commands.push([cobId, ...dataObjects.map((object) => object.value)]);
    device.setValue(0x6064, device.getValue(0x60FF));
});
device.eds.getEntry(0x6060).addListener('update', (mode) => device.setValue(0x6061, mode.value));

function announce(state) {
    if (state === NmtState.PRE_OPERATIONAL && previous === NmtState.INITIALIZING) {
        device.setValue(0x6041, STATUSWORD);
        send({ id: 0x700 + nodeId, data: Buffer.from([0]) });
    }
    previous = state;
    seen.states.push(state);
}
announce(device.state);

readline.createInterface({ input: process.stdin }).on('line', (line) => {
    const [cobId, data] = line.split('#');
    device.receive({ id: parseInt(cobId, 16), data: Buffer.from(data, 'hex'), len: data.length / 2 });
}).on('close', () => {
    process.stderr.write(JSON.stringify(seen) + '\n');
    process.exit(0);
});
