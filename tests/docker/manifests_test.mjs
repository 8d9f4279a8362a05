// docker/'s manifests against the schemas of Kubernetes' API; and what one file says of another.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {test} from 'node:test';
import yaml from 'js-yaml';

const read = (name) => readFileSync(new URL(`../../docker/${name}`, import.meta.url), 'utf8');
const objects = yaml.loadAll(read('kubernetes.yaml'));
const ofKind = (kind) => objects.find((object) => object.kind === kind);
const container = ofKind('Deployment').spec.template.spec.containers[0];

async function validate(object) {
  const {[object.kind]: Model} = await import(`kubernetes-models/${object.apiVersion}/${object.kind}`);
  new Model(object).validate();
}

test('every object of kubernetes.yaml is as the API wants it', async () => {
  const kinds = ['Deployment', 'Service', 'HorizontalPodAutoscaler', 'PodDisruptionBudget', 'NetworkPolicy'];
  assert.deepEqual(objects.map((object) => object.kind), kinds);
  for (const object of objects) await validate(object);
  await assert.rejects(validate({...ofKind('Deployment'), spec: {replicas: 'two'}}));
});

test('all of them speak of the same pods', () => {
  const labels = ofKind('Deployment').spec.template.metadata.labels;
  const selectors = [
    ofKind('Deployment').spec.selector.matchLabels, ofKind('Service').spec.selector,
    ofKind('PodDisruptionBudget').spec.selector.matchLabels, ofKind('NetworkPolicy').spec.podSelector.matchLabels,
  ];
  selectors.forEach((selector) => assert.deepEqual(selector, labels));
  assert.equal(ofKind('HorizontalPodAutoscaler').spec.scaleTargetRef.name, ofKind('Deployment').metadata.name);
});

test('settings are those of choreod, which drains within its grace', () => {
  const settings = container.env.map(({name}) => name);
  const flags = ['config_flags.cpp', '../client/cli/connection.cpp']
      .map((file) => readFileSync(new URL(`../../server/${file}`, import.meta.url), 'utf8')).join('');
  settings.forEach((name) => assert.ok(flags.includes(`"${name}"`), `nobody reads ${name}`));
  const drain = Number(container.env.find(({name}) => name === 'CHOREO_DRAIN_SECONDS').value);
  assert.ok(ofKind('Deployment').spec.template.spec.terminationGracePeriodSeconds >= drain + 5);
});

test('the metrics that others ask for are those that there are', () => {
  const source = readFileSync(new URL('../../server/metrics.cpp', import.meta.url), 'utf8');
  const exported = new Set([...source.matchAll(/"([a-z_]+)",\s*\n?\s*(?:"|\[)/g)].map(([, name]) => `choreo_${name}`));
  const asked = [...(read('grafana.json') + read('kubernetes.yaml')).matchAll(/\bchoreo_[a-z_]+/g)]
      .map(([name]) => name.replace(/_(bucket|sum|count)$/, ''));
  assert.ok(asked.length > 20);
  new Set(asked).forEach((name) => assert.ok(exported.has(name), `nobody exports ${name}`));
});

test('the dashboard is well formed, and no panel covers another', () => {
  const {panels} = JSON.parse(read('grafana.json'));
  const places = new Set(panels.map(({gridPos}) => `${gridPos.x},${gridPos.y}`));
  assert.equal(places.size, panels.length);
  panels.forEach((panel) => assert.ok(panel.targets.length > 0 && panel.description, panel.title));
});

test('containers of compose.yaml may do little', () => {
  const service = yaml.load(read('compose.yaml')).services.choreod;
  assert.equal(service.read_only, true);
  assert.notEqual(service.user.split(':')[0], '0');
  assert.ok(service.mem_limit && service.pids_limit);
  assert.ok(service.ports.every((port) => port.startsWith('127.0.0.1:')));
});
