#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# make_certificates.sh FOLDER: an authority of its own and one identity, valid for a day, with which
# two processes of a test can talk in secret.
set -euo pipefail
cd "$1"
openssl ecparam -name prime256v1 -genkey -noout -out ca_key.pem
openssl req -x509 -key ca_key.pem -out identity_ca.pem -days 1 -subj "/CN=test authority" -sha256
cp identity_ca.pem permissions_ca.pem
openssl ecparam -name prime256v1 -genkey -noout -out identity_key.pem
openssl req -new -key identity_key.pem -out request.pem -subj "/CN=host"
openssl x509 -req -in request.pem -CA identity_ca.pem -CAkey ca_key.pem -CAcreateserial \
  -out identity.pem -days 1 -sha256

# Cyclone DDS refuses a range of domains that ends behind 230.
domains="<domains><id_range><min>0</min><max>230</max></id_range></domains>"
cat >governance.xml <<END
<?xml version="1.0" encoding="UTF-8"?>
<dds><domain_access_rules><domain_rule>$domains
<allow_unauthenticated_participants>false</allow_unauthenticated_participants>
<enable_join_access_control>true</enable_join_access_control>
<discovery_protection_kind>ENCRYPT</discovery_protection_kind>
<liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
<rtps_protection_kind>ENCRYPT</rtps_protection_kind>
<topic_access_rules><topic_rule><topic_expression>*</topic_expression>
<enable_discovery_protection>true</enable_discovery_protection>
<enable_liveliness_protection>true</enable_liveliness_protection>
<enable_read_access_control>true</enable_read_access_control>
<enable_write_access_control>true</enable_write_access_control>
<metadata_protection_kind>NONE</metadata_protection_kind>
<data_protection_kind>NONE</data_protection_kind>
</topic_rule></topic_access_rules></domain_rule></domain_access_rules></dds>
END
cat >permissions.xml <<END
<?xml version="1.0" encoding="UTF-8"?>
<dds><permissions><grant name="host"><subject_name>CN=host</subject_name>
<validity><not_before>2020-01-01T00:00:00</not_before><not_after>2099-01-01T00:00:00</not_after></validity>
<allow_rule>$domains
<publish><topics><topic>*</topic></topics><partitions><partition>*</partition></partitions></publish>
<subscribe><topics><topic>*</topic></topics><partitions><partition>*</partition></partitions></subscribe>
</allow_rule><default>DENY</default></grant></permissions></dds>
END
for name in governance permissions; do
  openssl smime -sign -text -in $name.xml -out $name.p7s -signer permissions_ca.pem -inkey ca_key.pem
done
