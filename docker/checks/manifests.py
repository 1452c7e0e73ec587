"""Holds manifests to what an API server and a cluster would find out late: the restricted profile of pod security, limits,
selectors that select, ports and objects that there are, and time enough to stop.

usage: manifests.py FILE...      each as kustomize has built it
"""

import sys
from pathlib import Path

import yaml

ADAPTER = Path(__file__).resolve().parents[1] / "kubernetes/prometheus_adapter.yaml"
STOP_SECONDS = 2  # after --drain and --grace: server/OPERATIONS.md#stop


class Manifests:
    def __init__(self, text):
        self.objects = [each for each in yaml.safe_load_all(text) if each]
        self.pods = {each["metadata"]["name"]: each["spec"]["template"] for each in self.objects
                     if each["kind"] in ("Deployment", "StatefulSet")}  # fmt: skip

    def of(self, *kinds):
        return [each for each in self.objects if each["kind"] in kinds]

    def names(self, kind):
        return {each["metadata"]["name"] for each in self.of(kind)}

    def selected(self, selector):
        """The templates of pods that a selector matches."""
        labels = selector.get("matchLabels", {})
        wanted = selector.get("matchExpressions", [])

        def matches(pod):
            has = pod["metadata"]["labels"]
            return labels.items() <= has.items() and all(has.get(each["key"]) in each["values"] for each in wanted)

        return [pod for pod in self.pods.values() if matches(pod)]

    def configuration(self, container):
        """The variables that a container has by its ConfigMaps."""
        maps = {each["metadata"]["name"]: each["data"] for each in self.of("ConfigMap")}
        variables = {}
        for source in container.get("envFrom", []):
            variables.update(maps[source["configMapRef"]["name"]])
        return variables


def ports_of(pod):
    return {port["name"] for container in pod["spec"]["containers"] for port in container.get("ports", [])}


def restricted(spec):
    """https://kubernetes.io/docs/concepts/security/pod-security-standards/#restricted, and a read-only root."""
    pod = spec.get("securityContext", {})
    if pod.get("runAsNonRoot") is not True or not pod.get("runAsUser"):
        yield "may run as root"
    if pod.get("seccompProfile", {}).get("type") != "RuntimeDefault":
        yield "has no seccomp profile"
    if spec.get("automountServiceAccountToken") is not False:
        yield "has a token of the API"
    if any(spec.get(each) for each in ("hostNetwork", "hostPID", "hostIPC")):
        yield "shares a namespace with its node"
    for volume in spec.get("volumes", []):
        kinds = set(volume) - {"name"}
        if not kinds <= {"configMap", "emptyDir", "persistentVolumeClaim", "secret"}:
            yield f"has a volume of {kinds}"
    for container in spec["containers"]:
        own = container.get("securityContext", {})
        if own.get("allowPrivilegeEscalation") is not False or own.get("capabilities", {}) != {"drop": ["ALL"]}:
            yield f"{container['name']} has or may gain privileges"
        if own.get("readOnlyRootFilesystem") is not True:
            yield f"{container['name']} may write to its root"
        if own.get("privileged") or own.get("runAsUser") == 0:
            yield f"{container['name']} runs as root"


def contained(spec):
    """Limits, probes whose ports there are, and images of one version."""
    for container in spec["containers"]:
        name, resources = container["name"], container.get("resources", {})
        for part in ("requests", "limits"):
            if missing := {"cpu", "memory", "ephemeral-storage"} - set(resources.get(part, {})):
                yield f"{name} has no {part} of {missing}"
        if (tag := container["image"].rpartition(":")[2]) in ("latest", container["image"]):
            yield f"{name} has an image of any version: {tag}"
        ports = {port["name"] for port in container.get("ports", [])}
        for probe in ("livenessProbe", "readinessProbe"):
            if probe not in container:
                yield f"{name} has no {probe}"
                continue
            asked = container[probe].get("httpGet", container[probe].get("tcpSocket", {}))
            if asked and asked["port"] not in ports:
                yield f"{name} is probed at {asked['port']}, which it has not"
        mounted = {mount["name"] for mount in container.get("volumeMounts", [])}
        if mounted - {volume["name"] for volume in spec.get("volumes", [])} - {"data"}:
            yield f"{name} mounts a volume that there is not: {mounted}"


def references(manifests, spec):
    """ConfigMaps, Secrets and claims that a pod names and nobody makes."""
    named = {("ConfigMap", source["configMapRef"]["name"])
             for container in spec["containers"] for source in container.get("envFrom", [])}  # fmt: skip
    for volume in spec.get("volumes", []):
        if "configMap" in volume:
            named.add(("ConfigMap", volume["configMap"]["name"]))
        if "secret" in volume:
            named.add(("Secret", volume["secret"]["secretName"]))
        if "persistentVolumeClaim" in volume:
            named.add(("PersistentVolumeClaim", volume["persistentVolumeClaim"]["claimName"]))
    for kind, name in named:
        if name not in manifests.names(kind):
            yield f"there is no {kind} {name}"


def stops_in_time(manifests, spec):
    for container in spec["containers"]:
        variables = manifests.configuration(container)
        if "GNOMON_DRAIN" in variables:
            takes = int(variables["GNOMON_DRAIN"]) + int(variables["GNOMON_GRACE"]) + STOP_SECONDS
            if spec["terminationGracePeriodSeconds"] <= takes:
                yield f"is killed before it has ended, which takes {takes} s"


def selects(manifests):
    """Whatever selects pods has to find some, with the ports that it names."""
    for each in manifests.of("Service"):
        yield each, {"matchLabels": each["spec"]["selector"]}, {port["targetPort"] for port in each["spec"]["ports"]}
    for each in manifests.of("PodDisruptionBudget"):
        yield each, each["spec"]["selector"], set()
    for each in manifests.of("NetworkPolicy"):
        rules = each["spec"].get("ingress", [])
        yield each, each["spec"]["podSelector"], {port["port"] for rule in rules for port in rule.get("ports", [])}
        for rule in each["spec"].get("egress", []):
            for peer in rule["to"]:
                if "podSelector" in peer:
                    yield each, peer["podSelector"], {port["port"] for port in rule["ports"]}
        for rule in rules:
            for peer in rule.get("from", []):
                if "podSelector" in peer:
                    yield each, peer["podSelector"], set()


def most_replicas(manifests):
    """How many servers HAProxy takes from the DNS."""
    variables = [each for pod in manifests.pods.values() for container in pod["spec"]["containers"]
                 for each in container.get("env", [])]  # fmt: skip
    return next(int(each["value"]) for each in variables if each["name"] == "GNOMON_PROXY_MOST_REPLICAS")


def objects(manifests):
    for each, selector, ports in selects(manifests):
        name = f"{each['kind']} {each['metadata']['name']}"
        found = manifests.selected(selector)
        if not found:
            yield f"{name} selects no pod"
        for pod in found:
            if missing := ports - ports_of(pod):
                yield f"{name} names ports that its pods have not: {missing}"
    for each in manifests.of("ServiceMonitor"):
        wanted = each["spec"]["selector"]["matchLabels"].items()
        services = [service for service in manifests.of("Service") if wanted <= service["metadata"].get("labels", {}).items()]
        ports = {port["name"] for service in services for port in service["spec"]["ports"]}
        if missing := {endpoint["port"] for endpoint in each["spec"]["endpoints"]} - ports:
            yield f"ServiceMonitor finds no port {missing}"
    told = {rule["name"]["as"] for rule in yaml.safe_load(ADAPTER.read_text(encoding="utf-8"))["rules"]["custom"]}
    for each in manifests.of("HorizontalPodAutoscaler"):
        if each["spec"]["scaleTargetRef"]["name"] not in manifests.names(each["spec"]["scaleTargetRef"]["kind"]):
            yield "the HPA scales nothing"
        if each["spec"]["maxReplicas"] > (most := most_replicas(manifests)):
            yield f"the autoscaler starts more replicas than HAProxy takes: {most}"
        if missing := {metric["pods"]["metric"]["name"] for metric in each["spec"]["metrics"]} - told:
            yield f"the adapter does not tell {missing}"
    for each in manifests.objects:
        if each["kind"] != "Namespace" and each["metadata"].get("namespace") != "gnomon":
            yield f"{each['kind']} {each['metadata']['name']} is in no namespace"


def faults(text):
    manifests = Manifests(text)
    assert manifests.pods, "there is no pod"
    for name, pod in manifests.pods.items():
        spec = pod["spec"]
        for told in (*restricted(spec), *contained(spec), *references(manifests, spec), *stops_in_time(manifests, spec)):
            yield f"{name}: {told}"
    yield from objects(manifests)


def main():
    told = [f"{file}: {fault}" for file in sys.argv[1:] for fault in faults(Path(file).read_text(encoding="utf-8"))]
    print("\n".join(told), file=sys.stderr)
    return 1 if told or len(sys.argv) == 1 else 0


if __name__ == "__main__":
    sys.exit(main())
