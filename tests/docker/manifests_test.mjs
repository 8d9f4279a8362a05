// docker/'s manifests against the schemas of Kubernetes' API and of Prometheus' operator; and what one file says of another.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {test} from 'node:test';
import {parser as promql} from '@prometheus-io/lezer-promql';
import yaml from 'js-yaml';

const readSource = (name) => readFileSync(new URL(`../../${name}`, import.meta.url), 'utf8');
const read = (name) => readSource(`docker/${name}`);
const kustomization = yaml.load(read('kustomization.yaml'));
const objects = kustomization.resources.flatMap((name) => yaml.loadAll(read(name)));
const ofKind = (kind) => objects.find((object) => object.kind === kind);
const pod = ofKind('Deployment').spec.template.spec;
const container = pod.containers[0];
const setting = (name) => container.env.find((variable) => variable.name === name)?.value;
const alerts = ofKind('PrometheusRule').spec.groups.flatMap((group) => group.rules);
const metricSource = readSource('server/metrics.cpp') + readSource('server/figures.cpp');
const exported = new Set([...metricSource.matchAll(/"([a-z_]+)",\s*\n?\s*(?:"|\[)/g)].map(([, name]) => `choreo_${name}`));

async function validate(object) {
  const models = object.apiVersion.startsWith('monitoring.') ? '@kubernetes-models/prometheus-operator' : 'kubernetes-models';
  const {[object.kind]: Model} = await import(`${models}/${object.apiVersion}/${object.kind}`);
  new Model(object).validate();
}

// Where `text` is no PromQL.
function errorsOf(text) {
  const found = [];
  promql.parse(text).iterate({enter: ({type, from}) => { if (type.isError) found.push(from); }});
  return found;
}

// All objects inside of `value`, itself too.
function* parts(value) {
  if (value === null || typeof value !== 'object') return;
  yield value;
  for (const part of Object.values(value)) yield* parts(part);
}

test('every object that is applied is as its API wants it', async () => {
  const kinds = ['Deployment', 'Service', 'HorizontalPodAutoscaler', 'PodDisruptionBudget', 'NetworkPolicy', 'PodMonitor',
    'PrometheusRule'];
  assert.deepEqual(objects.map((object) => object.kind), kinds);
  for (const object of objects) await validate(object);
  await assert.rejects(validate({...ofKind('Deployment'), spec: {replicas: 'two'}}));
  await assert.rejects(validate({...ofKind('PodMonitor'), spec: {podMetricsEndpoints: 'metrics'}}));
});

test('the image has a registry and the tag of this release', () => {
  assert.equal(kustomization.images.length, 1);
  const [{name, newName, newTag}] = kustomization.images;
  assert.equal(container.image, name);
  assert.match(newName, /^[a-z0-9-]+(\.[a-z0-9-]+)+(:[0-9]+)?\/[a-z0-9/-]+$/);
  assert.equal(newTag, readSource('CMakeLists.txt').match(/project\(choreo VERSION ([0-9.]+)/)[1]);
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

test('settings are those of choreod, which waits and drains within its grace', () => {
  const flags = ['server/settings/config_flags.cpp', 'client/cli/options/connection.cpp'].map(readSource).join('');
  const settings = [...container.env.map(({name}) => name), ...['compose.yaml', 'compose.tls.yaml'].flatMap((file) => Object.keys(yaml.load(read(file)).services.choreod.environment))];
  settings.forEach((name) => assert.ok(flags.includes(`"${name}"`), `nobody reads ${name}`));
  const {command: [program, seconds]} = container.lifecycle.preStop.exec;
  assert.equal(program, 'sleep');
  assert.ok(Number(seconds) > 0);
  assert.ok(pod.terminationGracePeriodSeconds >= Number(seconds) + Number(setting('CHOREO_DRAIN_SECONDS')) + 5);
});

test('all probes ask the health of gRPC, where choreod listens and as it listens', () => {
  const port = container.ports.find(({name}) => name === 'grpc').containerPort;
  assert.ok(setting('CHOREO_LISTEN').endsWith(`:${port}`));
  // With TLS neither gRPC's probe of Kubernetes nor a client without these would be answered.
  assert.ok(setting('CHOREO_TLS_CERT') && setting('CHOREO_CA') && setting('CHOREO_SERVER_NAME'));
  assert.equal(setting('CHOREO_TLS'), 'true');
  for (const name of ['startupProbe', 'readinessProbe', 'livenessProbe']) {
    const {exec, ...others} = container[name];
    // What restarts a pod must not depend on a certificate, which a restart does not renew.
    const trust = name === 'readinessProbe' ? [] : ['--any-certificate'];
    assert.deepEqual(exec?.command, ['choreo', 'health', ...trust, '--server', `127.0.0.1:${port}`], name);
    ['grpc', 'tcpSocket', 'httpGet'].forEach((way) => assert.ok(!(way in others), name));
    // choreo gives up after 3 s by itself, and then says why.
    assert.ok(others.timeoutSeconds > 3, name);
  }
  assert.ok(container.livenessProbe.failureThreshold > container.readinessProbe.failureThreshold);
});

test('the pod has all that it may have, in whole cores', () => {
  assert.equal(pod.containers.length, 1);
  const {requests, limits} = container.resources;
  assert.deepEqual(Object.keys(limits).sort(), ['cpu', 'memory']);
  assert.deepEqual(requests, limits);
  assert.match(limits.cpu, /^[1-9][0-9]*$/);
});

test('calls are limited to what the page counts on for these kernels and cores', () => {
  const rows = [...readSource('docs/operations.md').matchAll(/^\| `([a-z0-9_]+)` \| ([0-9]+) \|/gm)];
  const capacity = Object.fromEntries(rows.map(([, kernels, dances]) => [kernels, Number(dances)]));
  assert.ok(capacity[setting('CHOREO_KERNELS')] > 0, `docs/operations.md says nothing of ${setting('CHOREO_KERNELS')}`);
  assert.ok(Number(setting('CHOREO_MAX_STREAMS')) <= capacity[setting('CHOREO_KERNELS')] * Number(container.resources.limits.cpu));
});

test('the metrics that others ask for are those that there are', () => {
  const files = ['alerts.yaml', 'grafana.json', 'kubernetes.yaml', 'monitoring.yaml', 'prometheus-adapter.yaml'].map(read).join('');
  const asked = [...files.matchAll(/\bchoreo_[a-z_]+/g)].map(([name]) => name.replace(/_(bucket|sum|count)$/, ''));
  assert.ok(asked.length > 20);
  new Set(asked).forEach((name) => assert.ok(exported.has(name), `nobody exports ${name}`));
});

test('the monitor finds where the pods show their metrics', () => {
  // A service forgets pods that are deleted, so it would show none that drains.
  const {jobLabel, selector, podMetricsEndpoints: [endpoint]} = ofKind('PodMonitor').spec;
  const {labels} = ofKind('Deployment').spec.template.metadata;
  assert.deepEqual(selector.matchLabels, labels);
  assert.equal(labels[jobLabel], ofKind('Service').metadata.name); // the job of the alerts
  const {containerPort} = container.ports.find(({name}) => name === endpoint.port);
  assert.equal(setting('CHOREO_METRICS'), `[::]:${containerPort}`); // clusters may have IPv6 alone
  assert.ok(metricSource.includes(`"${endpoint.path}"`));
  const allowed = ofKind('NetworkPolicy').spec.ingress.flatMap((rule) => rule.ports.map((open) => open.port));
  assert.deepEqual(allowed.sort(), container.ports.map(({name}) => name).sort());
});

test('without the operator the alerts come from a job of the same name', () => {
  const {rule_files: rules, scrape_configs: [job, ...others]} = yaml.load(read('prometheus.yaml'));
  assert.deepEqual(rules, ['alerts.yaml']);
  assert.deepEqual(others, []);
  assert.equal(job.job_name, ofKind('Service').metadata.name);
  // Prometheus' default, which choreod serves.
  assert.ok(!('metrics_path' in job) && metricSource.includes('"/metrics"'));
  const port = container.ports.find(({name}) => name === 'metrics').containerPort;
  job.static_configs.forEach(({targets}) => targets.forEach((target) => assert.ok(target.endsWith(`:${port}`))));
});

test('each pod is scraped once', () => {
  const {annotations = {}} = ofKind('Deployment').spec.template.metadata;
  assert.ok(ofKind('PodMonitor') && !Object.keys(annotations).some((name) => name.startsWith('prometheus.io/')));
});

test('clients of labelled namespaces reach the pods', () => {
  const [{from: [here, elsewhere]}] = ofKind('NetworkPolicy').spec.ingress;
  assert.deepEqual(elsewhere.podSelector, here.podSelector);
  assert.deepEqual(elsewhere.namespaceSelector, {matchLabels: {'choreo-clients': 'true'}});
  assert.ok(readSource('docs/kubernetes.md').includes('choreo-clients=true'));
});

test('the unit of systemd stops as slowly as the pods, and may open enough', () => {
  const unit = Object.fromEntries([...read('choreod.service.in').matchAll(/^([A-Za-z]+)=(.*)$/gm)].map(([, key, value]) => [key, value]));
  assert.ok(Number(unit.TimeoutStopSec) >= Number(setting('CHOREO_DRAIN_SECONDS')) + 10);
  assert.ok(Number(unit.LimitNOFILE) >= 65536);
  const reloads = [...read('choreod.service.in').matchAll(/^ExecReload=(.*)$/gm)].map(([, command]) => command);
  assert.equal(reloads[0], unit.ExecStart.replace(' --config', ' --check --config')); // a faulty file fails the reload
  assert.match(reloads[1], /-HUP/);
  assert.equal(unit.Type, 'notify'); // ServeTest.TellsItsManagerHowFarItIs
  assert.match(unit.ExecStart, /\/choreod --config \/etc\/choreo\/choreod\.toml$/);
});

test('alerts are PromQL on metrics and statuses that there are', () => {
  assert.equal(errorsOf('rate(choreo_frames_total[5m]) >').length, 1);
  const asked = new Set();
  const statuses = readSource('server/messages/status.cpp');
  for (const {alert, expr, labels, annotations} of alerts) {
    assert.deepEqual(errorsOf(expr), [], alert);
    assert.ok(['critical', 'warning'].includes(labels.severity) && annotations.summary, alert);
    const names = [...expr.matchAll(/\bchoreo_[a-z_]+/g)].map(([name]) => name);
    assert.ok(names.length > 0 || /\b(up|process_[a-z_]+)\b/.test(expr), alert);
    [...expr.matchAll(/\bprocess_[a-z_]+/g)].forEach(([name]) => assert.ok(metricSource.includes(`"${name.slice('process_'.length)}"`), name));
    names.forEach((name) => asked.add(name));
    [...expr.matchAll(/job="([a-z]+)"/g)].forEach(([, job]) => assert.equal(job, ofKind('Service').metadata.name, alert));
    const refusals = readSource('server/messages/refusal.h');
    [...expr.matchAll(/connections_total\{reason="([a-z]+)"/g)].forEach(([, reason]) => assert.ok(refusals.includes(`"${reason}"`), reason));
    [...expr.matchAll(/calls_total\{reason!~"([a-z_|]+)"/g)].flatMap(([, reasons]) => reasons.split('|'))
        .forEach((reason) => assert.ok(refusals.includes(`"${reason}"`), reason));
    [...expr.matchAll(/status="([A-Z_]+)"/g)].forEach(([, status]) => assert.ok(statuses.includes(`"${status}"`), status));
  }
  ['choreo_draining', 'choreo_refused_calls_total', 'choreo_lateness_seconds_bucket', 'choreo_calls_total', 'choreo_utilisation', 'choreo_engine_failures',
    'choreo_last_reload_successful', 'choreo_header_floods_total', 'choreo_empty_frame_floods_total', 'choreo_certificate_expiry_timestamp_seconds', 'choreo_tls_handshake_failures_total']
      .forEach((name) => assert.ok(asked.has(name), `nobody is woken for ${name}`));
  const scans = ['not_tls', 'timed_out']; // docs/runbook.md
  assert.match(alerts.find(({alert}) => alert === 'ChoreoHandshakesFail').expr, new RegExp(`reason!~"${scans.join('\\|')}"`));
  scans.forEach((reason) => assert.ok(readSource('server/connections/handshakes.h').includes(`"${reason}"`), reason));
  assert.equal(new Set(alerts.map(({alert}) => alert)).size, alerts.length);
});

test('what is wrong with one replica names it', () => {
  const named = alerts.filter(({annotations}) => annotations.summary.includes('$labels.instance'));
  named.forEach(({alert, expr}) => assert.ok(!/\b(sum|min|max|avg) by/.test(expr) || /by \([^)]*instance, pod/.test(expr), alert));
  for (const name of ['ChoreoReplicaIsDown', 'ChoreoEngineIsBroken', 'ChoreoFails', 'ChoreoIsLate', 'ChoreoIsShortOfMemory', 'ChoreoRestarts', 'ChoreoRefusesConnections'])
    assert.ok(named.some(({alert}) => alert === name), name);
});

test('alerts are the same with and without the operator, and the runbook has each', () => {
  assert.deepEqual(ofKind('PrometheusRule').spec.groups, yaml.load(read('alerts.yaml')).groups);
  const known = [...readSource('docs/runbook.md').matchAll(/^\| `(\w+)` \|/gm)].map(([, name]) => name);
  assert.deepEqual(known.filter((name) => name.startsWith('Choreo')), alerts.map(({alert}) => alert));
  const [, reasons] = readSource('server/connections/handshakes.h').match(/kHandshakeFaults = \{([^}]*)\}/);
  [...reasons.matchAll(/"(\w+)"/g)].forEach(([, reason]) => assert.ok(known.includes(reason), reason));
});

test('the adapter hands on what the autoscaler scales by, of each pod', () => {
  const [{pods}] = ofKind('HorizontalPodAutoscaler').spec.metrics;
  const [rule] = yaml.load(read('prometheus-adapter.yaml')).rules.custom;
  assert.equal(rule.name.as, pods.metric.name);
  assert.ok(rule.seriesQuery.startsWith(`${pods.metric.name}{`));
  assert.deepEqual(errorsOf(rule.seriesQuery), []);
  assert.deepEqual(Object.values(rule.resources.overrides).map(({resource}) => resource), ['namespace', 'pod']);
  const asked = rule.metricsQuery.replace('<<.Series>>', pods.metric.name).replace('<<.GroupBy>>', 'pod')
      .replace('<<.LabelMatchers>>', 'namespace="default"');
  assert.deepEqual(errorsOf(asked), []);
});

test('Envoy turns gRPC-Web into gRPC, for pages that are named', () => {
  const {listeners: [listener], clusters} = yaml.load(read('envoy.yaml')).static_resources;
  const [chain] = listener.filter_chains;
  const manager = chain.filters.at(-1).typed_config;
  assert.deepEqual(manager.http_filters.map(({name}) => name),
      ['envoy.filters.http.grpc_web', 'envoy.filters.http.cors', 'envoy.filters.http.router']);
  manager.http_filters.forEach(({name, typed_config: config}) =>
    assert.ok(config['@type'].startsWith(`type.googleapis.com/envoy.extensions.${name.slice('envoy.'.length)}.v3.`), name));
  // Browsers may speak HTTP/1.1.
  assert.equal(manager.codec_type, 'AUTO');
  assert.deepEqual(chain.transport_socket.typed_config.common_tls_context.alpn_protocols, ['h2', 'http/1.1']);
  const [host] = manager.route_config.virtual_hosts;
  const cors = host.typed_per_filter_config['envoy.filters.http.cors'];
  assert.ok(cors['@type'].endsWith('.cors.v3.CorsPolicy'));
  assert.ok(cors.allow_origin_string_match.every(({exact}) => exact?.startsWith('https://')));
  ['content-type', 'x-grpc-web', 'authorization'].forEach((name) => assert.ok(cors.allow_headers.split(',').includes(name), name));
  ['grpc-status', 'grpc-message', 'grpc-status-details-bin']
      .forEach((name) => assert.ok(cors.expose_headers.split(',').includes(name), name));
  for (const {match, route} of host.routes) {
    assert.deepEqual(match, {prefix: '/'});
    assert.ok(clusters.some(({name}) => name === route.cluster), route.cluster);
  }
  const [{health_checks: [check]}] = clusters;
  const proto = readSource('proto/choreo/v1/choreography.proto');
  assert.ok(proto.includes('package choreo.v1;') && proto.includes('service Choreography {'));
  assert.equal(check.grpc_health_check.service_name, 'choreo.v1.Choreography');
  // All dances that all replicas may have go through it, and who called is logged.
  const [{thresholds: [breaker]}] = clusters.map((cluster) => cluster.circuit_breakers);
  assert.ok(breaker.max_requests >= ofKind('HorizontalPodAutoscaler').spec.maxReplicas * Number(setting('CHOREO_MAX_STREAMS')));
  assert.equal(manager.use_remote_address, true);
  assert.equal(manager.access_log.length, 1);
  // Each type says its package and its name.
  for (const part of parts(yaml.load(read('envoy.yaml')))) {
    if ('@type' in part) assert.match(part['@type'], /^type\.googleapis\.com\/envoy\.extensions\.[a-z0-9_.]+\.v3\.[A-Z][A-Za-z]+$/);
  }
});

test('Envoy bounds connections and what each may hold', () => {
  const {overload_manager: {resource_monitors: [monitor]}, static_resources: {listeners: [listener], clusters: [cluster]}} = yaml.load(read('envoy.yaml'));
  const [chain] = listener.filter_chains;
  const [limit, {typed_config: manager}] = chain.filters;
  assert.equal(limit.name, 'envoy.filters.network.connection_limit');
  assert.equal(monitor.name, 'envoy.resource_monitors.global_downstream_max_connections');
  assert.ok(limit.typed_config.max_connections < monitor.typed_config.max_active_downstream_connections);
  [listener, cluster].forEach((side) => assert.ok(side.per_connection_buffer_limit_bytes <= 65536));
  const {max_concurrent_streams: calls, initial_stream_window_size: ofCall, initial_connection_window_size: ofAll} = manager.http2_protocol_options;
  assert.ok(calls <= 256 && ofCall >= 65535 && ofAll <= 1 << 20);
  assert.ok(chain.transport_socket_connect_timeout && manager.request_headers_timeout && manager.common_http_protocol_options.idle_timeout);
  // A dance takes as long as its music.
  assert.equal(manager.stream_idle_timeout, '0s');
  assert.ok(!('request_timeout' in manager));
});

test('manifests name the pages that say how to run them', () => {
  const pageOf = (name, what) => readSource(read(name).match(/docs\/[a-z]+\.md(?= says)/)[0]).includes(what);
  assert.ok(pageOf('kubernetes.yaml', 'create secret generic choreo-tls'));
  assert.ok(pageOf('envoy.yaml', 'docker/envoy.yaml:/etc/envoy'));
});

test('the pages make the files that the manifests want', () => {
  const [serve, deploy, kubernetes, tls] = ['docs/serve.md', 'docs/deploy.md', 'docs/kubernetes.md', 'docker/compose.tls.yaml'].map(readSource);
  for (const file of ['tls.crt', 'tls.key', 'ca.crt', 'tokens']) {
    [serve, deploy, kubernetes, tls].forEach((text) => assert.ok(text.includes(file), file));
    assert.match(deploy, new RegExp(`sudo install -m 400 -o ${pod.securityContext.runAsUser} [^\n]*\\b${file.replace('.', '\\.')}\\b`));
  }
  assert.ok(![serve, deploy, kubernetes, tls].some((text) => /\b(cert|key)\.pem\b/.test(text)));
  // One certificate is good for the container's own probe, for Envoy, and for the pods' probe.
  const names = serve.match(/subjectAltName=(\S+)/)[1].split(',');
  assert.ok(tls.includes('${CHOREO_SERVER_NAME:-localhost}') && names.includes('DNS:localhost'));
  assert.ok(names.includes(`DNS:${setting('CHOREO_SERVER_NAME')}`));
  const [{transport_socket: {typed_config: {sni}}}] = yaml.load(read('envoy.yaml')).static_resources.clusters;
  assert.ok(names.includes(`DNS:${sni}`));
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
  assert.ok(service.mem_limit);
  assert.ok(service.cpus > 0);
  // Of 28 threads that choreod has and 8 of its health check, several times as many; and calls that take one each are off.
  assert.ok(service.pids_limit >= 100);
  assert.equal(service.environment.CHOREO_REFLECTION, 'false');
  assert.match(service.image, /^\$\{CHOREO_IMAGE:-choreo\}$/);
  assert.ok(service.ports.every((port) => port.startsWith('${CHOREO_PUBLISH:-127.0.0.1}:')));
});

test('images have the version of the project', () => {
  const [, version] = readSource('CMakeLists.txt').match(/project\(choreo VERSION (\S+)/);
  const quoted = ['docker/compose.yaml', 'docker/kustomization.yaml', 'docs/deploy.md'].flatMap((file) =>
    [...readSource(file).matchAll(/(?:choreo:|newTag: )(\d+\.\d+\.\d+)/g)].map(([, of]) => of));
  assert.deepEqual(quoted, Array(3).fill(version));
});

test('with compose.tls.yaml nobody comes without TLS and a token', () => {
  const {environment: {CHOREO_INSECURE: insecure, ...settings}, volumes} = yaml.load(read('compose.tls.yaml')).services.choreod;
  assert.equal(insecure, 'false');
  for (const name of ['CHOREO_TLS_CERT', 'CHOREO_TLS_KEY', 'CHOREO_TOKENS', 'CHOREO_CA']) assert.ok(settings[name].startsWith('/secrets/'), name);
  assert.match(volumes[0], /:\/secrets:ro$/);
});
