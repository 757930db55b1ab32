// Planes to images and back, their digests, and connection files.
#include "protocol/connection.h"
#include "protocol/planes.h"
#include "vectors.h"

#include <QDir>
#include <QTemporaryDir>
#include <QtTest>

using namespace lampblack;
using namespace lampblack::protocol;

class Planes : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void digestIsTheVectors();
    void digestLeavesPaddingOut();
    void imageIsWhatCame();
    void putFrameFromAnImage();
    void connectionFile_data();
    void connectionFile();
};

void Planes::digestIsTheVectors()
{
    const QDir accept(QStringLiteral(LAMPBLACK_VECTORS "/accept"));
    const Case message = readCase(accept.filePath(QStringLiteral("put_frame-padded-rows")));
    const Decoded decoded = decodeCase(message);
    const auto& received = std::get<Received>(decoded);
    QVERIFY(received.planes.first().plane.stride > 4 * received.planes.first().plane.width);
    QVector<QImage> images;
    QVector<PlaneView> views;
    for (const PlaneView& plane : received.planes)
    {
        images.append(toImage(plane));
        views.append(viewOf(plane.plane.role, images.last()));
    }
    QCOMPARE(frameDigest(views), std::get<PutFrame>(received.message).digest);
}

void Planes::digestLeavesPaddingOut()
{
    // Format_Alpha8 pads a row of 3 to 4 bytes.
    QImage mask(3, 2, QImage::Format_Alpha8);
    mask.fill(7);
    const QByteArray before = rowsDigest(viewOf(Role::Mask, mask));
    mask.bits()[3] = 99;
    QCOMPARE(rowsDigest(viewOf(Role::Mask, mask)), before);
    mask.bits()[2] = 99;
    QVERIFY(rowsDigest(viewOf(Role::Mask, mask)) != before);
}

void Planes::imageIsWhatCame()
{
    // Two rows of one pixel, 3 bytes of padding, and bytes that no alignment can be hoped for.
    const QByteArray bytes("?RGBA...rgba...", 15);
    const PlaneView view = {{Role::Picture, Format::Rgba8Premultiplied, 1, 2, 7},
                            reinterpret_cast<const uchar*>(bytes.constData() + 1)};
    const QImage image = toImage(view);
    QCOMPARE(image.format(), QImage::Format_RGBA8888_Premultiplied);
    QCOMPARE(QByteArray(reinterpret_cast<const char*>(image.constScanLine(0)), 4), QByteArray("RGBA"));
    QCOMPARE(QByteArray(reinterpret_cast<const char*>(image.constScanLine(1)), 4), QByteArray("rgba"));
}

void Planes::putFrameFromAnImage()
{
    QImage drawing(5, 3, QImage::Format_RGBA8888);
    drawing.fill(QColor(200, 100, 50, 128));
    QImage ink(5, 3, QImage::Format_Grayscale8);
    ink.fill(255);
    const QVector<PlaneView> views = {viewOf(Role::Pixels, drawing), viewOf(Role::Ink, ink)};
    PutFrame put;
    put.frame = 3;
    put.digest = frameDigest(views);
    put.camera = QTransform(0.5, 0.25, -0.25, 0.5, 10, 20);
    put.planes = {views[0].plane, views[1].plane};
    const QByteArray header = encode(put).value();
    const Decoded decoded = decode({{header.constData(), header.size()},
                                    {drawing.constBits(), drawing.sizeInBytes()},
                                    {ink.constBits(), ink.sizeInBytes()}},
                                   Sender::Client);
    QVERIFY(std::holds_alternative<Received>(decoded));
    const auto& received = std::get<Received>(decoded);
    QCOMPARE(toImage(received.planes.first()), drawing);
    // x' = a x + b y + c, y' = d x + e y + f
    const QTransform camera = std::get<PutFrame>(received.message).camera;
    QCOMPARE(camera.map(QPointF(1, 2)), QPointF(0.5 - 0.5 + 10, 0.25 + 1 + 20));
    const QByteArray row = "\"camera\":[0.5,-0.25,10,0.25,0.5,20]";
    QVERIFY2(header.contains(row), header.constData());
}

void Planes::connectionFile_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<bool>("usable");
    const QByteArray end = "\",\"pid\":12}";
    const QByteArray good = "{\"lampblack\":1,\"minor\":0,\"endpoint\":\"ipc:///run/x/worker" + end;
    QTest::newRow("good") << good << true;
    QTest::newRow("of the future") << "{\"new\":[],\"lampblack\":2," + good.mid(15) << true;
    QTest::newRow("tcp") << QByteArray(good).replace("ipc:///", "tcp://h/") << false;
    QTest::newRow("control character") << QByteArray(good).replace("/x/", "/\\n/") << false;
    QTest::newRow("long") << QByteArray(good).replace("/x/", QByteArray(200, 'x')) << false;
    QTest::newRow("no process") << QByteArray(good).replace(":12", ":0") << false;
    QTest::newRow("cut short") << good.left(good.size() - 1) << false;
    QTest::newRow("endless") << QByteArray(100000, ' ') << false;
    QTest::newRow("deep") << QByteArray(1000, '[') << false;
}

void Planes::connectionFile()
{
    QFETCH(QByteArray, text);
    QFETCH(bool, usable);
    const QTemporaryDir folder;
    QFile file(folder.filePath(QStringLiteral("connection.json")));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(text);
    file.close();
    QString fault;
    const std::optional<Connection> connection = readConnection(file.fileName(), &fault);
    QCOMPARE(connection.has_value(), usable);
    QCOMPARE(fault.isEmpty(), usable);
    if (connection)
    {
        QCOMPARE(connection->pid, 12);
        QCOMPARE(connection->endpoint, QStringLiteral("ipc:///run/x/worker"));
    }
}

QTEST_GUILESS_MAIN(Planes)
#include "test_planes.moc"
