// Layers are painted over each other, and a single one keeps its colours.
#include "window/frame_painter.h"

#include <QTemporaryDir>
#include <QtTest>

namespace lampblack
{

class TestFramePainter : public QObject
{
    Q_OBJECT

    QString saved(const QString& name, const QColor& colour) const
    {
        QImage image(4, 3, QImage::Format_RGBA8888);
        image.fill(colour);
        const QString path = mFolder.filePath(name);
        return image.save(path) ? path : QString();
    }

    QTemporaryDir mFolder;

private Q_SLOTS:
    void upperLayersCoverLowerOnes()
    {
        const QString below = saved(QStringLiteral("below.png"), QColor(200, 0, 0));
        const QString above = saved(QStringLiteral("above.png"), QColor(0, 0, 200, 128));
        const QImage image = paintLayers({below, above}, {4, 3});
        QCOMPARE(image.format(), QImage::Format_RGBA8888);
        const QColor mixed = image.pixelColor(1, 1);
        QVERIFY(std::abs(mixed.red() - 100) <= 1 && std::abs(mixed.blue() - 100) <= 1);
        QCOMPARE(mixed.alpha(), 255);
    }

    void aTranslucentLayerKeepsItsColour()
    {
        const QColor faint(201, 77, 13, 3); // premultiplied, it would be another one
        QCOMPARE(paintLayers({saved(QStringLiteral("faint.png"), faint)}, {4, 3}).pixelColor(0, 0), faint);
    }

    void nothingIsTransparentAndAMissingLayerIsNoPicture()
    {
        QCOMPARE(paintLayers({}, {4, 3}).pixelColor(3, 2).alpha(), 0);
        QVERIFY(paintLayers({mFolder.filePath(QStringLiteral("missing.png"))}, {4, 3}).isNull());
    }
};

} // namespace lampblack

QTEST_GUILESS_MAIN(lampblack::TestFramePainter)
#include "test_frame_painter.moc"
