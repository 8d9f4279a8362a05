// The WebSocket to the program: sends calls and routes answers to their callers.
import { create, fromBinary, toBinary } from '@bufbuild/protobuf';
import type { MessageInitShape } from '@bufbuild/protobuf';
import { RequestSchema, ResponseSchema } from '../generated/studio/studio_pb';
import type { Response } from '../generated/studio/studio_pb';

type Body = NonNullable<MessageInitShape<typeof RequestSchema>['request']>;
type Listener = { onResponse: (response: Response) => void; onFailure: (error: Error) => void };

export class Wire {
  private socket?: WebSocket;
  private calls = new Map<number, Listener>();
  private last = 0;

  constructor(
    private readonly onWelcome: (response: Response) => void,
    private readonly onLost: () => void,
  ) {
    this.connect();
  }

  /// A call with many answers; `onResponse` gets each until `end`.
  open(body: Body, listener: Listener): number {
    const call = ++this.last;
    this.calls.set(call, listener);
    this.send(call, body);
    return call;
  }

  send(call: number, body: Body) {
    if (this.socket?.readyState === WebSocket.OPEN) {
      this.socket.send(toBinary(RequestSchema, create(RequestSchema, { call, request: body })));
    } else {
      this.calls.get(call)?.onFailure(new Error('The studio program is not there.'));
      this.calls.delete(call);
    }
  }

  end(call: number) {
    this.calls.delete(call);
  }

  /// A call with one answer.
  request(body: Body): Promise<Response['response']> {
    return new Promise((resolve, reject) => {
      const call = this.open(body, {
        onResponse: ({ response }) => {
          this.end(call);
          resolve(response);
        },
        onFailure: reject,
      });
    });
  }

  private connect() {
    const socket = new WebSocket(`ws://${location.host}/studio`);
    socket.binaryType = 'arraybuffer';
    socket.onmessage = ({ data }) => this.receive(fromBinary(ResponseSchema, new Uint8Array(data)));
    socket.onclose = () => {
      const calls = [...this.calls.values()];
      this.calls.clear();
      this.onLost();
      for (const { onFailure: failed } of calls) failed(new Error('The studio program is gone.'));
      setTimeout(() => this.connect(), 1000);
    };
    this.socket = socket;
  }

  private receive(response: Response) {
    if (response.response.case === 'welcome') return this.onWelcome(response);
    const listener = this.calls.get(response.call);
    if (!listener) return;
    if (response.response.case !== 'failure') return listener.onResponse(response);
    this.calls.delete(response.call);
    listener.onFailure(new Error(response.response.value.message));
  }
}
