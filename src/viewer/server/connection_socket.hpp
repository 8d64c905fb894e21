#pragma once

struct mg_connection;

namespace stdc {

/// The socket of a connection, which CivetWeb has no call for: the one of this process between the two ports
/// and the address that the connection names. It stays CivetWeb's, which closes it. -1: there is none.
int socket_of(const mg_connection* connection);

}  // namespace stdc
