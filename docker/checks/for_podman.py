"""Writes the part of built manifests that podman 4.3 can play, one file for each of their services, with the images that
there are: each pod with its containers, limits, security context, volumes and configuration as they stand.

usage: for_podman.py MANIFESTS FOLDER IMAGE...      IMAGE is NAME=IMAGE, for the container of that name

What podman does not know is written otherwise. A StatefulSet is a Deployment, its claims are volumes. A Secret is a
ConfigMap, since podman breaks on both ways to hand one in. Ports are left out, since each would be published; so are
probes, which nothing runs without systemd. Services, policies and autoscalers are nothing to podman.
"""

import base64
import sys
from pathlib import Path

import yaml


def as_config_map(secret):
    data = {key: base64.b64decode(value).decode() for key, value in secret["data"].items()}
    return {"apiVersion": "v1", "kind": "ConfigMap", "metadata": {"name": secret["metadata"]["name"]}, "data": data}


def as_deployment(workload, images):
    spec = workload["spec"]
    pod = spec["template"]["spec"]
    volumes = pod.setdefault("volumes", [])
    for claim in spec.pop("volumeClaimTemplates", []):
        name = claim["metadata"]["name"]
        volumes.append({"name": name, "persistentVolumeClaim": {"claimName": f"{workload['metadata']['name']}-{name}"}})
    for volume in volumes:
        if "secret" in volume:
            volume["configMap"] = {"name": volume.pop("secret")["secretName"]}
    for container in pod["containers"]:
        container["image"] = images[container["name"]]
        for unknown in ("ports", "startupProbe", "livenessProbe", "readinessProbe", "lifecycle"):
            container.pop(unknown, None)
    spec.setdefault("replicas", 2)  # where an autoscaler decides
    workload["kind"] = "Deployment"
    return workload


def main():
    file, folder, *pairs = sys.argv[1:]
    images = dict(pair.split("=", 1) for pair in pairs)
    objects = [each for each in yaml.safe_load_all(Path(file).read_text(encoding="utf-8")) if each]
    configuration = [each for each in objects if each["kind"] == "ConfigMap"]
    configuration += [as_config_map(each) for each in objects if each["kind"] == "Secret"]
    for each in objects:
        if each["kind"] in ("Deployment", "StatefulSet"):
            name = each["metadata"]["name"]
            told = yaml.safe_dump_all([*configuration, as_deployment(each, images)])
            (Path(folder) / f"{name}.yaml").write_text(told, encoding="utf-8")


main()
