// The golden vectors of protocol/vectors, as folders of frames.
#pragma once

#include "protocol/codec.h"

#include <QString>
#include <QVector>

namespace lampblack::protocol
{

/// A message as it would come: its frames, who sent it and under which limits it is to be read.
struct Case
{
    QString name;
    QVector<QByteArray> frames;
    Sender sender = Sender::Client;
    Limits limits;
    QJsonObject expected;
};

Case readCase(const QString& folder);
QVector<Case> readCases(const QString& folder);

/// Write a case's frames and its sender, for another implementation to read.
bool writeCase(const QString& folder, const Case& message);

QVector<Bytes> bytesOf(const QVector<QByteArray>& frames);
Decoded decodeCase(const Case& message);

/// A verdict in the form in which implementations are compared (SPEC 9).
QJsonObject verdict(const Decoded& decoded);

} // namespace lampblack::protocol
