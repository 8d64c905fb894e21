# docker build -t stdc-slam .    then    docker run --rm -v DATA:/data stdc-slam run /data/SEQUENCE --output /data/results
FROM debian:bookworm-slim AS build
WORKDIR /source
COPY scripts/install-packages scripts/packages.txt scripts/
RUN scripts/install-packages
COPY . .
RUN cmake -S . -B /build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DBUILD_SHARED_LIBS=ON \
      -DSTDC_BUILD_TESTS=OFF -DSTDC_BUILD_SIMULATION=OFF -DSTDC_BUILD_BENCHMARKS=OFF -DSTDC_BUILD_TOOLS=OFF \
 && cmake --build /build \
 && (cd /build && apt-get install -y -qq dpkg-dev file >/dev/null && cpack -B /packages >/dev/null)

FROM debian:bookworm-slim
COPY --from=build /packages/stdc-slam_*.deb /packages/stdc-slam-models_*.deb /packages/
RUN apt-get update -qq \
 && apt-get install -y -qq --no-install-recommends /packages/*.deb \
 && rm -rf /packages /var/lib/apt/lists/* \
 && useradd --create-home slam
USER slam
WORKDIR /data
ENTRYPOINT ["stdc-slam"]
CMD ["--help"]
