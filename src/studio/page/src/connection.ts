// The connection with the server. It comes back by itself when it is lost.

import {readBinary, type Frame, type Message} from './protocol';

export interface Listener {
  message(message: Message): void;
  frame(frame: Frame): void;
  file(format: string, content: ArrayBuffer): void;
  connected(isConnected: boolean): void;
}

const retryMilliseconds = 1000;

export class Connection {
  private socket: WebSocket | null = null;
  private nextId = 1;
  private readonly waiting = new Map<number, (result: unknown) => void>();

  constructor(private readonly token: string, private readonly listener: Listener) {
    this.connect();
  }

  send(message: Record<string, unknown>): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  /** Sends a message that is answered. The answer is null where there is none. */
  ask(message: Record<string, unknown>): Promise<unknown> {
    const id = this.nextId++;
    return new Promise((resolve) => {
      if (!this.send({...message, id})) return resolve(null);
      this.waiting.set(id, resolve);
    });
  }

  private connect(): void {
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    const address = `${scheme}://${location.host}/socket?token=${encodeURIComponent(this.token)}`;
    const socket = new WebSocket(address);
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    socket.onmessage = (event) => this.receive(event.data as string | ArrayBuffer);
    socket.onclose = () => {
      for (const resolve of this.waiting.values()) resolve(null);
      this.waiting.clear();
      this.listener.connected(false);
      setTimeout(() => this.connect(), retryMilliseconds);
    };
    socket.onopen = () => this.listener.connected(true);
  }

  private receive(data: string | ArrayBuffer): void {
    if (typeof data !== 'string') {
      const binary = readBinary(data);
      if (!binary) return;
      if ('file' in binary) return this.listener.file(binary.format, binary.file);
      this.listener.frame(binary);
      if (binary.isLast) this.send({type: 'acknowledge', picture: binary.picture});
      return;
    }
    const message = JSON.parse(data) as Message;
    if (message.type === 'answer' || (message.type === 'error' && message.id !== undefined)) {
      const resolve = this.waiting.get(message.id!);
      this.waiting.delete(message.id!);
      resolve?.(message.type === 'answer' ? message.result : null);
      if (message.type === 'answer') return;
    }
    this.listener.message(message);
  }
}
