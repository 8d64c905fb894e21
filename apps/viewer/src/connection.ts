import { PIECE_HEADER, PROTOCOL, Topic } from "./protocol";

export interface Listener {
  onOpen(): void;
  onClose(): void;
  onMessage(topic: Topic, bytes: Uint8Array): void;
  onStranger(version: number): void;
}

interface Transfer { revision: number; bytes: Uint8Array; filled: number }

// Puts the pieces of messages together: of each topic one is under way at a time.
export class Assembler {
  private readonly underWay = new Map<Topic, Transfer>();

  // The whole message when its last piece is here.
  add(piece: ArrayBuffer): { topic: Topic; bytes: Uint8Array } | null {
    if (piece.byteLength < PIECE_HEADER) return null;
    const view = new DataView(piece);
    const topic: Topic = view.getUint8(0);
    const revision = view.getUint32(4, true), total = view.getUint32(8, true), offset = view.getUint32(12, true);
    const part = new Uint8Array(piece, PIECE_HEADER);
    let transfer = this.underWay.get(topic);
    if (offset === 0) {
      transfer = { revision, bytes: new Uint8Array(total), filled: 0 };
      this.underWay.set(topic, transfer);
    }
    if (!transfer || transfer.revision !== revision || transfer.filled !== offset) return null;
    if (offset + part.length > transfer.bytes.length) return null;
    transfer.bytes.set(part, offset);
    transfer.filled += part.length;
    if (transfer.filled < transfer.bytes.length) return null;
    this.underWay.delete(topic);
    return { topic, bytes: transfer.bytes };
  }
}

// The WebSocket to the program, opened again whenever it ends.
export class Connection {
  private socket: WebSocket | null = null;
  private wanted = 0;
  private ended = false;
  private patience = 1500;   // until it is tried again [ms]
  private opened = false;    // once at least

  constructor(private readonly listener: Listener) {
    this.open();
  }

  want(wanted: number) {
    if (wanted === this.wanted) return;
    this.wanted = wanted;
    this.send(`want ${wanted}`);
  }

  send(request: string) {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(request);
  }

  // The run is over: there is nobody to connect to.
  end() { this.ended = true; }

  private open() {
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(`${scheme}//${location.host}/live${location.search}`);
    const assembler = new Assembler();
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      // A link that ends so holds a run of --view-wait after its first frame.
      if (location.hash === "#paused" && !this.opened) this.send("pause");
      this.opened = true;
      this.patience = 1500;
      this.send(`want ${this.wanted}`);
      this.listener.onOpen();
    };
    socket.onmessage = (event: MessageEvent<ArrayBuffer>) => {
      const version = new DataView(event.data).getUint8(1);
      if (version !== PROTOCOL) {
        this.ended = true;
        this.listener.onStranger(version);
        socket.close();
        return;
      }
      const message = assembler.add(event.data);
      if (message) this.listener.onMessage(message.topic, message.bytes);
    };
    socket.onclose = () => {
      this.listener.onClose();
      if (this.ended) return;
      setTimeout(() => { if (!this.ended) this.open(); }, this.patience);
      this.patience = Math.min(15000, 1.5 * this.patience);
    };
    this.socket = socket;
  }
}
