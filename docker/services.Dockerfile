# What stands beside the server, from Debian's packages: for machines that can't or may not pull the official images,
# whose users, folders and commands these have. `docker build -f docker/services.Dockerfile --target redis docker`; the
# targets are redis, haproxy and prometheus.
ARG BASE=debian:bookworm-slim

FROM $BASE AS redis
RUN apt-get update && apt-get install -y --no-install-recommends redis-server redis-tools && rm -rf /var/lib/apt/lists/* \
 && groupmod -g 999 redis && usermod -u 999 redis \
 && install -d -o redis -g redis -m 0700 /data
USER 999:999
WORKDIR /data
VOLUME /data
EXPOSE 6379
CMD ["redis-server"]

FROM $BASE AS haproxy
RUN apt-get update && apt-get install -y --no-install-recommends haproxy && rm -rf /var/lib/apt/lists/* \
 && groupmod -g 99 haproxy && usermod -u 99 haproxy
USER 99:99
STOPSIGNAL SIGUSR1
CMD ["haproxy", "-W", "-db", "-f", "/usr/local/etc/haproxy/haproxy.cfg"]

FROM $BASE AS prometheus
RUN apt-get update && apt-get install -y --no-install-recommends prometheus && rm -rf /var/lib/apt/lists/* \
 && install -d -o nobody -g nogroup /prometheus
USER 65534:65534
WORKDIR /prometheus
VOLUME /prometheus
EXPOSE 9090
ENTRYPOINT ["/usr/bin/prometheus"]
CMD ["--config.file=/etc/prometheus/prometheus.yml", "--storage.tsdb.path=/prometheus"]
