// Colours of light by their temperature.
#include "scene/temperature.h"

#include <QtTest>

using namespace lampblack;

class TemperatureTest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void daylightIsNearlyWhite()
    {
        const QColor white = colourOfKelvin(6504);
        QVERIFY(white.red() > 250 && white.green() > 243 && white.blue() > 243);
    }

    void knownTemperaturesHaveTheirKnownColours_data()
    {
        // M. Charity, blackbody colours, CIE 1931 2 degrees, sRGB (vendian.org/mncharity/dir3/blackbody).
        QTest::addColumn<double>("kelvin");
        QTest::addColumn<QColor>("expected");
        QTest::newRow("candle") << 2000.0 << QColor(0xff, 0x89, 0x12);
        QTest::newRow("lamp") << 3000.0 << QColor(0xff, 0xb4, 0x6b);
        QTest::newRow("sky") << 10000.0 << QColor(0xcc, 0xdb, 0xff);
    }

    void knownTemperaturesHaveTheirKnownColours()
    {
        QFETCH(double, kelvin);
        QFETCH(QColor, expected);
        const QColor colour = colourOfKelvin(kelvin);
        const QString seen = colour.name();
        constexpr int Near = 12;
        QVERIFY2(qAbs(colour.red() - expected.red()) <= Near, qPrintable(seen));
        QVERIFY2(qAbs(colour.green() - expected.green()) <= Near, qPrintable(seen));
        QVERIFY2(qAbs(colour.blue() - expected.blue()) <= Near, qPrintable(seen));
    }

    void aColourTellsItsTemperature()
    {
        for (const double kelvin : {1900.0, 2700.0, 4500.0, 6500.0, 9000.0})
            QVERIFY(qAbs(kelvinOfColour(colourOfKelvin(kelvin)) - kelvin) < 0.03 * kelvin);
        QCOMPARE(qRound(kelvinOfColour(Qt::red)), int(WarmestKelvin));
        QCOMPARE(qRound(kelvinOfColour(Qt::blue)), int(ColdestKelvin));
    }
};

QTEST_APPLESS_MAIN(TemperatureTest)
#include "test_temperature.moc"
