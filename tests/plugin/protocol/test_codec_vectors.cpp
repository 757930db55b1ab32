// The decoder's verdicts on the golden vectors, and that the encoder writes what the decoder reads.
#include "protocol/header.h"
#include "scene/scene.h"
#include "vectors.h"

#include <QDir>
#include <QtTest>

using namespace lampblack;
using namespace lampblack::protocol;

namespace
{

const Received& received(const Decoded& decoded)
{
    return std::get<Received>(decoded);
}

QVector<Case> cases(const char* kind)
{
    return readCases(QDir(QStringLiteral(LAMPBLACK_VECTORS)).filePath(QLatin1String(kind)));
}

} // namespace

class CodecVectors : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void accepted();
    void refused();
    void encodedAgain();
    void refusalNamesItsRequest();
    void manyMaterialsFit();
    void aSceneThatIsTooLargeIsToldOf();
    void headerBeginsLiterally();
};

void CodecVectors::accepted()
{
    const QVector<Case> all = cases("accept");
    QVERIFY(all.size() >= 25);
    for (const Case& message : all)
    {
        QJsonObject expected = message.expected;
        expected.remove(QStringLiteral("sender"));
        QVERIFY2(verdict(decodeCase(message)) == expected, qPrintable(message.name));
    }
}

void CodecVectors::refused()
{
    const QVector<Case> all = cases("reject");
    QVERIFY(all.size() >= 40);
    for (const Case& message : all)
    {
        const Decoded decoded = decodeCase(message);
        const auto* refusal = std::get_if<Refusal>(&decoded);
        QVERIFY2(refusal != nullptr, qPrintable(message.name));
        QVERIFY2(name(refusal->code) == message.expected.value(QLatin1String("code")).toString(),
                 qPrintable(message.name + QLatin1String(": ") + name(refusal->code)));
    }
}

void CodecVectors::encodedAgain()
{
    const QVector<Case> all = cases("accept");
    for (Case message : all)
    {
        const Decoded first = decodeCase(message);
        message.frames[0] = encode(received(first).message).value();
        const Decoded second = decodeCase(message);
        QVERIFY2(std::holds_alternative<Received>(second), qPrintable(message.name));
        QCOMPARE(messageTree(received(second).message), messageTree(received(first).message));
    }
}

void CodecVectors::refusalNamesItsRequest()
{
    const QByteArray header = headerBeginning() + "\"type\":\"preview\",\"request\":7,\"frame\":-1}";
    const Decoded decoded = decode(bytesOf({header}), Sender::Client);
    const auto& refusal = std::get<Refusal>(decoded);
    QCOMPARE(refusal.code, ErrorCode::BadField);
    QCOMPARE(refusal.about, QStringLiteral("preview"));
    QCOMPARE(refusal.request, std::optional<quint64>(7));
    QVERIFY(refusal.details.startsWith(QLatin1String("frame")));
}

void CodecVectors::manyMaterialsFit()
{
    Scene scene = defaultScene({1920, 1080});
    for (int i = 0; i < 4096; ++i)
    {
        scene.materials.insert(QStringLiteral("#%1").arg(i * 4096, 6, 16, QLatin1Char('0')), Material());
    }
    const std::optional<QByteArray> header = encode(SetScene{1, scene});
    QVERIFY(header);
    const Decoded decoded = decode(bytesOf({*header}), Sender::Client);
    QVERIFY(std::get<SetScene>(received(decoded).message).scene == scene);
}

void CodecVectors::aSceneThatIsTooLargeIsToldOf()
{
    Scene scene = defaultScene({1920, 1080});
    scene.extra.insert(QStringLiteral("note"), QString(Limits().headerBytes, QLatin1Char('x')));
    QVERIFY(!encode(SetScene{1, scene}));
}

void CodecVectors::headerBeginsLiterally()
{
    const QByteArray header = encode(Bye{QStringLiteral("gone")}).value();
    QCOMPARE(header, QByteArray("{\"lampblack\":1,\"reason\":\"gone\",\"type\":\"bye\"}"));
}

QTEST_GUILESS_MAIN(CodecVectors)
#include "test_codec_vectors.moc"
